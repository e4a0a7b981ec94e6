"""The Python interface: `lostmotion.analyse(...)`, `lostmotion.map(...)` and their results."""
