// Keeps a test program buildable while its room has no tests yet.
