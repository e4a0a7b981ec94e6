"""Measures of chaos: kinds of motion, exponents, dimensions, surrogate tests, maps of models, and what they identify.

It uses the framework as any other package could: all that it adds is registered by hooks, names only.
"""

from lostmotion.hookspecs import hookimpl

_HERE = "lostmotion_chaos"


@hookimpl
def lostmotion_embedders() -> dict[str, str]:
    """Return the built-in embedders, named DELAY_DIMENSION after the methods for the delay and for the dimension."""
    at = f"{_HERE}.embedders.choices"
    return {
        "ami_cao": f"{at}:AmiCao",
        "ami_fnn": f"{at}:AmiFnn",
        "ami_knn_cao": f"{at}:AmiKnnCao",
        "autocorrelation_cao": f"{at}:AutocorrelationCao",
        "fixed": f"{at}:Fixed",
    }


@hookimpl
def lostmotion_quantifiers() -> dict[str, str]:
    """Return the built-in quantifiers: those that read recordings and those that read the flow of a model."""
    at = f"{_HERE}.quantifiers"
    return {
        "correlation_dimension": f"{at}.dimension:CorrelationDimension",
        "correlation_entropy": f"{at}.dimension:CorrelationEntropy",
        "kaplan_yorke": f"{at}.flows:KaplanYorke",
        "lyapunov_kantz": f"{at}.kantz:Kantz",
        "lyapunov_max": f"{at}.flows:LyapunovMax",
        "lyapunov_rosenstein": f"{at}.rosenstein:Rosenstein",
        "lyapunov_spectrum": f"{at}.flows:LyapunovSpectrum",
        "lyapunov_wolf": f"{at}.wolf:Wolf",
        "mutual_information": f"{at}.cheap:MutualInformation",
        "noise_level": f"{at}.noise:NoiseLevel",
        "prediction_error": f"{at}.cheap:PredictionError",
        "section_dimension": f"{at}.section:SectionDimension",
        "time_reversal": f"{at}.cheap:TimeReversal",
    }


@hookimpl
def lostmotion_surrogates() -> dict[str, str]:
    """Return the built-in surrogates."""
    at = f"{_HERE}.surrogates"
    return {
        "aaft": f"{at}.spectral:Aaft",
        "fourier": f"{at}.spectral:Fourier",
        "iaaft": f"{at}.iterated:Iaaft",
        "pseudo_periodic": f"{at}.cycles:PseudoPeriodic",
    }


@hookimpl
def lostmotion_denoisers() -> dict[str, str]:
    """Return the built-in denoisers."""
    at = f"{_HERE}.denoisers"
    return {
        "local_projective": f"{at}.projective:LocalProjective",
        "simple_nonlinear": f"{at}.simple:SimpleNonlinear",
    }


@hookimpl
def lostmotion_commands() -> dict[str, tuple[str, str]]:
    """Return the commands."""
    return {
        "analyse": (f"{_HERE}.commands.analyse:command", "Classify a recorded motion as periodic, chaotic or noise."),
        "map": (f"{_HERE}.commands.map:command", "Map an exponent or another quantity over parameters."),
        "reproduce": (f"{_HERE}.paper.command:command", "Reproduce the figures and tables of the paper of 2007."),
    }


@hookimpl
def lostmotion_functions() -> dict[str, tuple[str, str]]:
    """Return the functions of the Python interface: two commands, and the steps of an analysis."""
    return {
        "analyse": (f"{_HERE}.notebook.doors:analyse", "Return the kind of motion in a recording."),
        "denoise": (f"{_HERE}.analysis.denoise:denoise", "Return a series with less noise."),
        "embed": (f"{_HERE}.analysis.embed:embed", "Return a series with delay and dimension."),
        "map": (f"{_HERE}.notebook.doors:map", "Return a map of a model over parameters."),
        "quantify": (f"{_HERE}.analysis.quantify:quantify", "Return a number that a quantifier estimates."),
        "surrogate_test": (f"{_HERE}.analysis.surrogates:surrogate_test", "Return the test of a null hypothesis."),
    }


@hookimpl
def lostmotion_results() -> dict[str, tuple[str, str]]:
    """Return the function that reads the result of `analyse`."""
    return {"analysis.json": (f"{_HERE}.notebook.analysis:load_analysis", "The kind of motion in a recording.")}


@hookimpl
def lostmotion_routes() -> dict[str, tuple[str, str]]:
    """Return the route from measures of chaos to parameters."""
    return {"quantifiers": (f"{_HERE}.levels.route:prepare_quantifiers", "Exponents and dimensions at drive levels.")}


@hookimpl
def lostmotion_measures() -> dict[str, tuple[str, str]]:
    """Return what a diagnosis measures of the motions of recording and models."""
    about = "Distances between attractors, and correlation dimensions."
    return {"attractors": (f"{_HERE}.attractors:measure_attractors", about)}
