"""Ranks of the samples that bound a median at 95 %, in whole numbers: rows of test_bench_statistics.c.

[x_k, x_(n+1-k)] misses the median where fewer than k of n coins show heads, or fewer than k tails.
"""
from fractions import Fraction
from math import comb

for n in (1, 2, 5, 6, 8, 9, 10, 11, 20, 25, 50, 100, 999, 1000, 3000):
    def coverage(k):
        return 1 - Fraction(2 * sum(comb(n, i) for i in range(k)), 2 ** n)
    k = 1
    while 2 * (k + 1) <= n and coverage(k + 1) >= Fraction(95, 100):
        k += 1
    print(f"    {{{n}, {k}, {float(coverage(k)):.9f}}},")
