"""Parameters estimated from measures of chaos at several levels of the drive."""
