"""Many cases or trials in one go, over the cores of this machine, each kept as it ends."""
