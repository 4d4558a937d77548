"""How to look at it: the command line, recordings, pictures, films, goldens, benches."""
