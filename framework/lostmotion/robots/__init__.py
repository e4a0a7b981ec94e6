"""Machines with many joints, of which the user has a simulation: the physics that it lacks, and the joint.

The simulation is asked once for its inverse dynamics along the recorded path (`tape`). Every likelihood then runs in
compiled code, and terms of the library act as generalised forces at joints.
"""
