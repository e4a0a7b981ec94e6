"""Simulators of machines with many joints: MuJoCo, URDF files through its loader, and a function of the user."""
