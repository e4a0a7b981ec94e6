"""`lostmotion prove`: effects are hidden in machines, diagnosed blind, and scored."""
