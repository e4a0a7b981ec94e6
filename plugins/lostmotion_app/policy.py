"""What a browser may load for the page: nothing from another address."""

POLICY = (
    "default-src 'none'; script-src 'self' 'unsafe-inline' 'unsafe-eval'; style-src 'self' 'unsafe-inline';"
    " img-src 'self' data: blob:; font-src 'self' data:; connect-src 'self' ws:; base-uri 'none'; form-action 'none'"
)
"""Panel makes functions of texts, and styles of elements, so these two are allowed inside of the page."""
