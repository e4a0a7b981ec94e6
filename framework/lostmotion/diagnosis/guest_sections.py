"""The sections that other packages add to the page of a diagnosis by the hook `lostmotion_sections`."""

from __future__ import annotations

from functools import partial

from lostmotion.diagnosis.report.diagnosis_page import SECTIONS, Guests
from lostmotion.diagnosis.report.page_data import Evidence
from lostmotion.errors import PluginError
from lostmotion.offers import SECTION
from lostmotion.registry import Registry
from lostmotion.report.pages import PageSection


def find_sections(registry: Registry) -> Guests:
    """Return the sections of other packages by name, each with the function that loads it."""
    return {name: partial(_load_section, registry, name) for name in registry.offered(SECTION)}


def _load_section(registry: Registry, name: str) -> PageSection[Evidence]:
    """Return a section; raise `PluginError` where it cannot be loaded, is no section, or has a name of the page."""
    if name in {one.name for one in SECTIONS}:
        raise PluginError(f"the page has a section {name!r} of its own: give the section another name")
    section = registry.function(SECTION, name)()
    if not isinstance(section, PageSection):
        raise PluginError(f"the section {name!r} is of the type {type(section).__name__}: return a PageSection")
    return section._replace(name=name)
