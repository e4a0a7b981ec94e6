"""The likelihood that survives chaos, and what is done with it: fits, evidence, the missing force, predictions."""
