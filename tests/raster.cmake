# Tests of this kind, by name.
