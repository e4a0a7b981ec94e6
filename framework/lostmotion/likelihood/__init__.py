"""The likelihood of recordings: what measures, what is free, and the engines that filter many points at once.

`Sensor` and `Observation` say what was measured, `ParameterSpace` what is to be estimated, `System` what moves, and an
`Engine` returns one-step errors; `Problem` puts them together into the posterior density that fits and samplers see.
"""
