"""The page of an analysis: reads its result and curves, and computes nothing."""
