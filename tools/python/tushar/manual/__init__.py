"""The manual: a static site made from schemas, head comments of scenes, pages, messages and C++ headers."""
