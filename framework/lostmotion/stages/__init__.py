"""The verbs: each takes data and nouns, and returns a frozen result."""
