"""From a case to a cause: run, search, held-out comparison, sentences, arrays and the page."""
