"""The likelihood of recordings: sensors, free parameters, and the engines that filter many parameter points at once.

`Sensor` and `Observation` describe what was measured, `ParameterSpace` what is estimated and `System` the model with
its terms. An `Engine` returns innovations. `Problem` combines them into the posterior density for fits and samplers.
"""
