"""A trial of arms with two joints: what each lacks is hidden, and the diagnosis has to name joint and physics."""
