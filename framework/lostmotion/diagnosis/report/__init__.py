"""The page of a diagnosis: reads its result and arrays, and computes nothing."""
