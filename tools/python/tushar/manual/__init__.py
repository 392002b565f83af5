"""The manual: a static site made of schemas, heads of scenes, pages, messages and C++ headers."""
