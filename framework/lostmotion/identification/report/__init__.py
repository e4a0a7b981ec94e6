"""The page of an identification: reads its result and draws, and computes nothing."""
