"""From a case to a posterior: run, sampling, both routes, and the page."""
