"""Equations of motion as text, `m*x'' + c*x' + k*x = force`: read, checked and solved for the accelerations.

Names that are neither a coordinate, an input nor a known function are parameters. A coordinate is a name with a second
derivative; each equation contains that of one coordinate, times one parameter, its mass. Inputs are `force`, `torque`,
names with these endings, such as `second_force`, and `base_position`, `base_velocity` and `base_acceleration`.
"""

from lostmotion.equations.read import FUNCTIONS, Node
from lostmotion.equations.recorded_inputs import name_inputs
from lostmotion.equations.structure import BodyEquation, Equations, Spring, equations_of

__all__ = ["FUNCTIONS", "BodyEquation", "Equations", "Node", "Spring", "equations_of", "name_inputs"]
