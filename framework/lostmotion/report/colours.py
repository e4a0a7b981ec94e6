"""The colours of all figures: those of Okabe and Ito.

Colour-blind readers can distinguish them, and their lightness differs in grey print.
"""

RECORDED = "#1a1a1a"
BEFORE = "#d55e00"
AFTER = "#0072b2"
LAW = "#00664b"
QUIET = "#8c8c8c"
SHADE = "#e9eef3"
