"""The page of an identification: it shows the result and its draws, and computes nothing."""
