"""From what a user hands in to what is worked on: the case, its terms, and plugins that were held against the kit."""
