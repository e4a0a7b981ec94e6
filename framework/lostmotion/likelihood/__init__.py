"""The likelihood of recordings: sensors, free parameters, and systems that run at many points at once.

`Sensor` and `Observation` describe what was measured, `ParameterSpace` what is estimated and `System` the model with
its terms. A `RunningSystem` returns innovations. `Posterior` combines them into the density for fits and samplers.
"""
