"""Many cases or trials in one run on the cores of this machine; each result is stored when it is complete."""
