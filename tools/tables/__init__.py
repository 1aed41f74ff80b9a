"""What the reports share: reading tables, writing them, statistics.

`read` reads rows by the names of their columns, `markdown` writes tables, and
`statistics`, which alone needs numpy and scipy, has intervals and tests.
Scripts beside this folder use it; `make check CHECKS=tables` tests it.
"""
