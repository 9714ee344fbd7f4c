"""The atlas: a page for every small graph, made of what `verify` prints."""
