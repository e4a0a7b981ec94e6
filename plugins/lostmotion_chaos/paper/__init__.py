"""Reproduces the figures and tables of Tjahjowidodo, Al-Bender and Van Brussel (2007) with our own simulations."""
