"""Every rule of lostmotion, for everything that this package offers."""

from lostmotion_template.dynamics import TwoJointArm
from lostmotion_template.models import DrivenPendulum
from lostmotion_template.noises import FlickerNoise
from lostmotion_template.simulators import TwoLink
from lostmotion_template.terms import MaxwellElement

from lostmotion import testing


@testing.parametrize([DrivenPendulum, FlickerNoise, MaxwellElement, TwoJointArm, TwoLink])
def test_conforms(component, rule):
    """Each rule is a test of its own; one that fails says what to do."""
    testing.assert_conforms(component, rule)
