"""The figures and tables of Tjahjowidodo, Al-Bender and Van Brussel (2007) from runs of our own."""
