"""`lostmotion demo`: friction is hidden in a simulated robot joint, and found."""
