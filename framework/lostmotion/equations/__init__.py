"""A machine written down as equations, `m*x'' + c*x' + k*x = force`: read, checked and solved for accelerations.

Names that are neither a coordinate, an input nor a known function are parameters. A coordinate is what a second
derivative stands of; each equation holds that of one coordinate, times one parameter, its mass. Inputs are `force`,
`torque`, names that end so, such as `second_force`, and `base_position`, `base_velocity` and `base_acceleration`.
"""

from lostmotion.equations.read import FUNCTIONS, Node
from lostmotion.equations.structure import BodyEquation, Equations, Spring, equations_of

__all__ = ["FUNCTIONS", "BodyEquation", "Equations", "Node", "Spring", "equations_of"]
