"""One score for each explanation: hypotheses, each fitted with a model discrepancy, and the search for them."""
