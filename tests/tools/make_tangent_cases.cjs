// Writes tests/tangent_cases.h: meshes and the tangents that the npm package "mikktspace" gives them, which
// is Mikkelsen's own program.  npm install mikktspace; node tests/tools/make_tangent_cases.cjs >tests/tangent_cases.h
const { generateTangents } = require('mikktspace');

let seed = 1;
const random = () => (seed = (seed * 1103515245 + 12345) % 2147483648) / 2147483648;
const unit = v => { const l = Math.hypot(...v) || 1; return v.map(x => x / l); };
const corner = (p, n, t) => [...p, ...n, ...t].map(Math.fround);

function grid(columns, rows, place, uv) {
    const triangles = [];
    const at = (i, k) => { const p = place(i / columns, k / rows); return corner(p.position, p.normal, uv(i / columns, k / rows)); };
    for (let k = 0; k < rows; k++)
        for (let i = 0; i < columns; i++) {
            const a = at(i, k), b = at(i + 1, k), c = at(i + 1, k + 1), d = at(i, k + 1);
            triangles.push([a, b, c], [a, c, d]);
        }
    return triangles;
}

const sphere = (u, v) => {
    const a = 2 * Math.PI * (u === 1 ? 0 : u), b = Math.PI * v, r = v === 0 || v === 1 ? 0 : Math.sin(b);
    const n = [r * Math.cos(a), Math.cos(b), r * Math.sin(a)];
    return { position: n, normal: unit(n) };
};
const hills = (u, v) => {
    const x = 4 * u, z = 4 * v;
    return { position: [x, Math.sin(x) * Math.cos(z), z],
             normal: unit([-Math.cos(x) * Math.cos(z), 1, Math.sin(x) * Math.sin(z)]) };
};
const flat = (u, v) => ({ position: [u, v, 0], normal: [0, 0, 1] });

function soup() {
    const points = Array.from({ length: 12 }, () => {
        const p = [random(), random(), random()].map(x => 2 * x - 1);
        return corner(p, unit(p), [random(), random()]);
    });
    return Array.from({ length: 60 }, () => [0, 0, 0].map(() => points[Math.floor(random() * 12)]));
}

// A map that winds twice around a corner: triangles across from each other have it exactly opposite.
function winding() {
    const n = [0, 0, 1], at = i => {
        const [x, y] = [[4, 0], [4, 4], [0, 4], [-4, 4], [-4, 0], [-4, -4], [0, -4], [4, -4]][i % 8];
        return corner([x, y, 0], n, [x * x - y * y, 2 * x * y]);
    };
    return [0, 1, 2, 3, 4, 5, 6, 7].map(i => [corner([0, 0, 0], n, [0, 0]), at(i), at(i + 1)]);
}

const meshes = {
    'a sphere with a seam, and triangles without area at its poles': grid(8, 6, sphere, (u, v) => [u, v]),
    'a surface whose map is mirrored at its middle': grid(6, 2, flat, (u, v) => [Math.abs(2 * u - 1), v]),
    'hills with a map turned and stretched': grid(6, 6, hills, (u, v) => [3 * u + v, v - 0.5 * u]),
    'coordinates that stand still in one column': grid(5, 3, hills, (u, v) => [u > 0.3 && u < 0.7 ? 0.3 : u, u > 0.3 && u < 0.7 ? 0.1 : v]),
    'coordinates that stand still everywhere': grid(2, 2, flat, () => [0.5, 0.5]),
    'triangles that share corners in every way': soup(),
    'a map that winds twice around a corner': winding(),
    'a map that folds back and forth': grid(8, 3, hills, (u, v) => [Math.round(8 * u) % 2, v]),
};

const number = x => { const s = Math.fround(x).toPrecision(9); return (/[.e]/.test(s) ? s : s + '.0') + 'f'; };
const out = [];
out.push('/* Made by tests/tools/make_tangent_cases.cjs; w has the sign of glTF, which is the opposite. */',
         '#ifndef TL_TANGENT_CASES_H', '#define TL_TANGENT_CASES_H', '', '#include <stddef.h>', '',
         '/* Position, normal, uv of a corner, and its tangent. */',
         'typedef struct tangent_corner {', '    float position[3], normal[3], uv[2], tangent[4];', '} tangent_corner;', '');
const names = Object.keys(meshes);
names.forEach((name, m) => {
    const corners = meshes[name].flat();
    const pick = (from, count) => new Float32Array(corners.flatMap(c => c.slice(from, from + count)));
    const tangents = generateTangents(pick(0, 3), pick(3, 3), pick(6, 2));
    out.push(`static const tangent_corner tangent_corners_${m}[] = {`);
    corners.forEach((c, i) => {
        const t = [tangents[4 * i], tangents[4 * i + 1], tangents[4 * i + 2], -tangents[4 * i + 3]];
        const list = a => '{' + a.map(number).join(', ') + '}';
        out.push(`    {${list(c.slice(0, 3))}, ${list(c.slice(3, 6))}, ${list(c.slice(6, 8))}, ${list(t)}},`);
    });
    out.push('};', '');
});
out.push('static const struct {', '    const char *name;', '    const tangent_corner *corners;', '    size_t count;', '} tangent_cases[] = {');
names.forEach((name, m) => out.push(`    {"${name}", tangent_corners_${m}, sizeof tangent_corners_${m} / sizeof *tangent_corners_${m}},`));
out.push('};', '', '#endif');
console.log(out.join('\n'));
