"""The page of a diagnosis: it shows the result and its arrays, and computes nothing."""
