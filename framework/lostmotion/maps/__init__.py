"""Maps: any quantity of any model over any parameters, computed cell by cell, stored in chunks, and read again."""
