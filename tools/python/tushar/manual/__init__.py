"""The manual: a static site made of the schemas, the heads of the scenes, the pages, the messages and the C++ headers."""
