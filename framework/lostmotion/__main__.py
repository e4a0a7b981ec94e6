"""`python -m lostmotion` is the command `lostmotion`."""

from lostmotion.cli import main

if __name__ == "__main__":
    main(prog_name="lostmotion")
