"""`lostmotion demo`: a robot joint hides friction, and it is found."""
