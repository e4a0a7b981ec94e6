"""A trial on robot arms: what each lacks is hidden, and the diagnosis has to name joint and physics."""
