"""Colours of the map of lights per tile, for tests/test_command_explain.c: Oklab by its definition (B. Ottosson,
"A perceptual color space for image processing", 2020), by way of cone responses and XYZ, which the program
does not take."""
import math

M1 = ((0.8189330101, 0.3618667424, -0.1288597137), (0.0329845436, 0.9293118715, 0.0361456387),
      (0.0482003018, 0.2643662691, 0.6338517070))
M2 = ((0.2104542553, 0.7936177850, -0.0040720468), (1.9779984951, -2.4285922050, 0.4505937099),
      (0.0259040371, 0.7827717662, -0.8086757660))
XYZ_OF_RGB = ((0.4123907993, 0.3575843394, 0.1804807884),  # Rec. 709, D65
              (0.2126390059, 0.7151686788, 0.0721923154), (0.0193308187, 0.1191947798, 0.9505321522))


def determinant(m):
    return sum(m[0][i] * (m[1][(i + 1) % 3] * m[2][(i + 2) % 3] - m[1][(i + 2) % 3] * m[2][(i + 1) % 3])
               for i in range(3))


def solved(m, v):
    """By Cramer's rule."""
    return [determinant([[v[r] if c == i else m[r][c] for c in range(3)] for r in range(3)]) / determinant(m)
            for i in range(3)]


for at in (0.0, 0.5, 1.0):
    hue = math.radians(280.0 + 185.0 * at)
    lab = (0.38 + 0.52 * at, 0.15 * math.cos(hue), 0.15 * math.sin(hue))
    linear = solved(XYZ_OF_RGB, solved(M1, [c ** 3 for c in solved(M2, lab)]))
    assert min(linear) >= 0.0 and max(linear) <= 1.0
    print(at, [255 * (12.92 * c if c <= 0.0031308 else 1.055 * c ** (1 / 2.4) - 0.055) for c in linear])
