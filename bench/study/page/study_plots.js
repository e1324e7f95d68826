/* Plots of a study, drawn by d3 into an SVG element: by the page, and by scripts/study-svg for files. They
 * look as plot.css says. Widths and heights are in px; texts are measured by a guess, since files are drawn
 * where no fonts are. */
var studyPlots = (function () {
    'use strict';

    const TEXT = 12;
    const namespace = 'http://www.w3.org/2000/svg';
    const shapes = { storage: 'symbolCircle', arithmetic: 'symbolTriangle', approximation: 'symbolDiamond',
                     culling: 'symbolStar', output: 'symbolCross', none: 'symbolWye' };

    /* Of the widest of the fonts in plot.css, in bold, about. */
    function widthOf(text) {
        return 7.5 * text.length;
    }

    function mark(d3, cause, size) {
        return d3.symbol().type(d3[shapes[cause] || shapes.none]).size(size)();
    }

    /* An empty plot with a name that is read out. */
    function begin(d3, node, width, height, title) {
        const svg = d3.select(node).attr('class', 'plot').attr('viewBox', '0 0 ' + width + ' ' + height)
            .attr('width', width).attr('height', height).attr('aria-label', title);
        svg.selectAll('*').remove();
        svg.append('rect').attr('class', 'paper').attr('width', width).attr('height', height);
        return svg;
    }

    /* --- axes --- */

    function decades(low, high) {
        const all = [];
        for (let e = Math.floor(Math.log10(low) + 1e-9); e <= Math.ceil(Math.log10(high) - 1e-9); e++)
            all.push(Math.pow(10, e));
        return all;
    }

    /* Powers of ten, so few that their texts fit. */
    function powerTicks(domain, most) {
        const isInside = v => v >= domain[0] * 0.999 && v <= domain[1] * 1.001;
        const all = decades(domain[0], domain[1]).filter(isInside);
        const step = Math.ceil(all.length / Math.max(1, most));
        return all.filter((v, i) => (all.length - 1 - i) % step === 0);
    }

    function power(value) {
        return value.toExponential(0);
    }

    /* Whole decades around values above 0. */
    function errorScale(d3, values, range) {
        const some = values.filter(v => v > 0);
        const all = some.length ? decades(d3.min(some), d3.max(some)) : [1e-8, 1];
        const top = all.length > 1 ? all[all.length - 1] : 10 * all[0];
        return d3.scaleLog().domain([all[0], top]).range(range);
    }

    /* Logarithmic where the slowest is many times the fastest. */
    function timeScale(d3, values, range, room) {
        const low = d3.min(values), high = d3.max(values);
        if (!(low > 0))
            return d3.scaleLinear().domain([0, 1]).range(range);
        if (high < 4 * low)
            return d3.scaleLinear().domain([0, 1.08 * high]).range(range);
        const more = Math.pow(high / low, room);
        return d3.scaleLog().domain([low / (1.15 * more), 1.2 * high]).range(range);
    }

    function timeTicks(scale, most) {
        if (!scale.base)
            return scale.ticks(Math.min(8, most));
        const domain = scale.domain(), isInside = v => v >= domain[0] && v <= domain[1];
        const of = steps => [].concat(...decades(domain[0], domain[1]).map(d => steps.map(s => s * d)));
        const few = of([1, 2, 5]).filter(isInside);
        return few.length > 3 ? few : of([1, 1.5, 2, 3, 4, 5, 6, 8]).filter(isInside);
    }

    function plain(value) {
        return String(+value.toPrecision(6));
    }

    function axes(d3, svg, box, x, y, spec) {
        const xTicks = timeTicks(x, (box.right - box.left) / 60), yTicks = powerTicks(y.domain(), 10);
        const grid = svg.append('g').attr('class', 'grid').attr('aria-hidden', 'true');
        grid.selectAll('.row').data(yTicks).enter().append('line')
            .attr('x1', box.left).attr('x2', box.right).attr('y1', v => y(v)).attr('y2', v => y(v));
        grid.selectAll('.column').data(xTicks).enter().append('line')
            .attr('x1', v => x(v)).attr('x2', v => x(v)).attr('y1', box.top).attr('y2', box.bottom);
        svg.append('g').attr('class', 'axis-x').attr('transform', 'translate(0,' + box.foot + ')')
            .call(d3.axisBottom(x).tickValues(xTicks).tickFormat(plain).tickSizeOuter(0));
        svg.append('g').attr('class', 'axis-y').attr('transform', 'translate(' + box.left + ',0)')
            .call(d3.axisLeft(y).tickValues(yTicks).tickFormat(power).tickSizeOuter(0));
        svg.append('text').attr('x', box.right).attr('y', box.foot + 40).attr('text-anchor', 'end')
            .text(spec.xTitle + ' → slower');
        svg.append('text').attr('x', 4).attr('y', box.top - 14).text('↑ ' + spec.yTitle);
    }

    /* --- the front --- */

    /* Where a point stands: errors of 0, and those not known, have rows of their own under the axis, and
     * times that are not known a column beside it. */
    function place(point, x, y, box) {
        const isKnown = typeof point.y === 'number' && isFinite(point.y);
        return {
            x: point.x ? x(point.x.median) : box.left + box.gutter / 2,
            y: !isKnown ? box.unknown : point.y > 0 ? y(point.y) : box.zero,
        };
    }

    function rowsBelow(svg, box) {
        [[box.zero, '0'], [box.unknown, 'none']].filter(row => row[0] !== null).forEach(row => {
            svg.append('line').attr('class', 'usual').attr('x1', box.left).attr('x2', box.right)
                .attr('y1', row[0]).attr('y2', row[0]);
            svg.append('text').attr('class', 'quiet').attr('x', box.left - 9).attr('y', row[0] + 4)
                .attr('text-anchor', 'end').text(row[1]);
        });
    }

    function columnBeside(svg, box) {
        const at = box.left + box.gutter;
        if (box.gutter === 0)
            return;
        svg.append('line').attr('class', 'usual').attr('x1', at).attr('x2', at)
            .attr('y1', box.top).attr('y2', box.foot);
        svg.append('text').attr('class', 'quiet').attr('x', box.left + box.gutter / 2)
            .attr('y', box.foot + 18).attr('text-anchor', 'middle').text('none');
    }

    function layOut(points, width) {
        const hasZero = points.some(p => p.y === 0);
        const hasUnknown = points.some(p => typeof p.y !== 'number' || !isFinite(p.y));
        const box = { left: 54, top: 40, right: width - 16, isNarrow: width < 560 };
        box.gutter = points.some(p => !p.x) ? 40 : 0;
        box.bottom = box.top + (box.isNarrow ? 340 : 420);
        box.zero = hasZero ? box.bottom + 24 : null;
        box.unknown = hasUnknown ? box.bottom + (hasZero ? 48 : 24) : null;
        box.foot = box.bottom + 24 * (hasZero + hasUnknown) + (hasZero || hasUnknown ? 14 : 0);
        return box;
    }

    /* A staircase: what is up and to the right of it is beaten. */
    function frontLine(d3, svg, box, points, places, isScreen) {
        const on = points.filter(p => p.number && p.isForScreen === isScreen)
            .map(p => places[p.index]).sort((a, b) => a.x - b.x || b.y - a.y);
        if (on.length > 1)
            svg.append('path').attr('class', 'front' + (isScreen ? ' screen' : ''))
                .attr('d', d3.line().x(p => p.x).y(p => p.y).curve(d3.curveStepAfter)(on));
    }

    function drawInterval(group, point, x, box) {
        if (!point.x || !(point.x.samples > 0))
            return;
        const least = box.left + box.gutter, clamp = v => Math.max(least, Math.min(box.right, v));
        const at = x(point.x.median);
        const low = clamp(point.x.low > 0 ? x(point.x.low) : least), high = clamp(x(point.x.high));
        group.append('line').attr('class', 'interval').attr('x1', low - at).attr('x2', high - at);
        [low, high].filter(v => v > least && v < box.right).forEach(v =>
            group.append('line').attr('class', 'interval').attr('x1', v - at).attr('x2', v - at)
                .attr('y1', -3).attr('y2', 3));
    }

    function drawPoint(d3, group, point, x, box) {
        drawInterval(group, point, x, box);
        group.append('path').attr('class', 'mark').attr('d', mark(d3, point.cause, point.number ? 90 : 52));
        if (point.isForScreen)
            group.append('rect').attr('class', 'frame').attr('x', -8).attr('y', -8)
                .attr('width', 16).attr('height', 16);
        if (point.isUnstable)
            group.append('text').attr('class', 'unstable-sign').attr('x', 8).attr('y', -5).text('!');
    }

    function drawPoints(d3, svg, box, x, places, points) {
        const order = points.slice().sort((a, b) => (a.number ? 1 : 0) - (b.number ? 1 : 0));
        const classOf = p => ['point', shapes[p.cause] ? p.cause : 'none', p.number ? 'on-front' : '',
                              p.isUnstable ? 'unstable' : ''].filter(c => c).join(' ');
        const groups = svg.append('g').attr('class', 'points').selectAll('g').data(order).enter().append('g')
            .attr('class', classOf)
            .attr('data-index', p => p.index)
            .attr('aria-label', p => p.says)
            .attr('transform', p => 'translate(' + places[p.index].x + ',' + places[p.index].y + ')');
        groups.each(function (point) {
            drawPoint(d3, d3.select(this), point, x, box);
        });
    }

    function meets(a, b) {
        return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
    }

    /* Boxes that a text of this width may have around a point, the best first: left and below a front there
     * is nothing. */
    function boxesAround(at, width) {
        const row = (side, y) => side < 0 ? { x0: at.x - 10 - width, x1: at.x - 10, y0: y - 8, y1: y + 8 }
                                          : { x0: at.x + 10, x1: at.x + 10 + width, y0: y - 8, y1: y + 8 };
        const all = [];
        [14, 0, -14, 30, -30, 46, -46, 62].forEach(down => all.push(row(-1, at.y + down)));
        [14, 0, -14, 30, -30, 46, -46, 62].forEach(down => all.push(row(1, at.y + down)));
        return all;
    }

    /* Names of what is on the front, as far as there is room; their numbers otherwise. */
    function drawLabels(svg, box, points, places) {
        const taken = points.map(p => places[p.index])
            .map(at => ({ x0: at.x - 6, x1: at.x + 6, y0: at.y - 6, y1: at.y + 6 }));
        const isInside = b => b.x0 > box.left + 2 && b.x1 < box.right && b.y0 > box.top - 10 &&
            b.y1 < box.foot;
        const isFree = b => isInside(b) && !taken.some(t => meets(t, b));
        const layer = svg.append('g').attr('class', 'labels').attr('aria-hidden', 'true');
        points.filter(p => p.number).sort((a, b) => a.number - b.number).forEach(point => {
            const number = String(point.number), name = number + '  ' + point.label;
            for (const text of box.isNarrow ? [number] : [name, number]) {
                const found = boxesAround(places[point.index], widthOf(text)).find(isFree);
                if (!found)
                    continue;
                taken.push(found);
                layer.append('text').attr('class', 'strong over').attr('x', found.x0)
                    .attr('y', found.y0 + 12).text(text);
                return;
            }
        });
    }

    /* Entries of a legend, in rows; returns the height that they take. */
    function drawLegend(d3, svg, left, right, top, entries) {
        let x = left, y = top + 8;
        entries.forEach(entry => {
            const width = 26 + widthOf(entry.text);
            if (x > left && x + width > right) {
                x = left;
                y += 22;
            }
            entry.draw(svg.append('g').attr('class', entry.class)
                .attr('transform', 'translate(' + (x + 8) + ',' + y + ')'));
            svg.append('text').attr('x', x + 22).attr('y', y + 4).text(entry.text);
            x += width + 16;
        });
        return y + 12 - top;
    }

    function frontLegend(d3, points) {
        const used = Object.keys(shapes).filter(c => points.some(p => p.cause === c));
        const entries = used.map(cause => ({
            class: cause + ' on-front', text: cause === 'none' ? 'no error' : 'mostly ' + cause,
            draw: g => g.append('path').attr('class', 'mark').attr('d', mark(d3, cause, 90)),
        }));
        entries.push({
            class: 'none', text: 'hollow: beaten by another',
            draw: g => g.append('path').attr('class', 'mark').attr('d', mark(d3, 'storage', 52)),
        });
        if (points.some(p => p.isForScreen))
            entries.push({ class: 'none', text: 'framed: errors of what a screen shows', draw: g =>
                g.append('rect').attr('class', 'frame').attr('x', -8).attr('y', -8).attr('width', 16)
                    .attr('height', 16) });
        if (points.some(p => p.isUnstable))
            entries.push({ class: 'none', text: 'unstable time', draw: g =>
                g.append('text').attr('class', 'unstable-sign').attr('x', -2).attr('y', 4).text('!') });
        return entries;
    }

    /* Error over time. spec: {width, xTitle, yTitle, isRatio, points}; a point: {index, label, says, x: a
     * time of the study or null, y: an error or null, cause, isForScreen, isUnstable, number: on the front,
     * from 1 on, else 0}. Returns where points stand, [index] = {x, y}. */
    function front(d3, node, spec) {
        const box = layOut(spec.points, spec.width), points = spec.points;
        const legend = frontLegend(d3, points);
        const title = spec.yTitle + ' over ' + spec.xTitle.toLowerCase();
        const svg = begin(d3, node, spec.width, box.foot + 200, title);
        const x = timeScale(d3, points.filter(p => p.x).map(p => p.x.median),
                            [box.left + box.gutter, box.right], box.isNarrow ? 0.05 : 0.25);
        const y = errorScale(d3, points.map(p => p.y), [box.bottom, box.top]);
        const places = [];
        points.forEach(p => { places[p.index] = place(p, x, y, box); });
        axes(d3, svg, box, x, y, spec);
        rowsBelow(svg, box);
        columnBeside(svg, box);
        if (spec.isRatio)
            svg.append('line').attr('class', 'usual').attr('x1', x(1)).attr('x2', x(1))
                .attr('y1', box.top).attr('y2', box.foot);
        [false, true].forEach(isScreen => frontLine(d3, svg, box, points, places, isScreen));
        drawPoints(d3, svg, box, x, places, points);
        drawLabels(svg, box, points, places);
        const height = box.foot + 56 + drawLegend(d3, svg, 8, box.right, box.foot + 56, legend);
        svg.attr('height', height).attr('viewBox', '0 0 ' + spec.width + ' ' + height);
        svg.select('.paper').attr('height', height);
        return places;
    }

    /* --- causes --- */

    /* Names of rows stand on their left, or where columns would be too narrow for texts beside bars above. */
    function columnsOf(spec) {
        const longest = Math.max(0, ...spec.rows.map(r => widthOf(r.label)));
        const names = ['total'].concat(spec.causes), beside = Math.max(120, Math.min(300, longest + 20));
        const isNarrow = (spec.width - beside) / names.length < 122, left = isNarrow ? 8 : beside;
        const gap = isNarrow ? 8 : 18;
        const width = (spec.width - 12 - left - gap * (names.length - 1)) / names.length;
        return { isNarrow: isNarrow, left: left, width: width, names: names,
                 at: i => left + i * (width + gap), barWidth: isNarrow ? width : width - 46,
                 row: isNarrow ? 50 : 24, top: isNarrow ? 52 : 34 };
    }

    function causesHead(d3, svg, columns, scale, foot) {
        columns.names.forEach((name, i) => {
            const at = columns.at(i), isFit = widthOf(name) <= columns.width + 6;
            svg.append('text').attr('class', 'strong').attr('x', at).attr('y', 22)
                .text(isFit ? name : name.slice(0, Math.floor(columns.width / widthOf('x')) - 1) + '.');
            const ticks = powerTicks(scale.domain(), Math.max(2, columns.barWidth / 50));
            const axis = svg.append('g').attr('transform', 'translate(' + at + ',' + foot + ')')
                .call(d3.axisBottom(scale).tickValues(ticks).tickFormat(power).tickSizeOuter(0)
                    .tickSizeInner(-(foot - columns.top)).tickPadding(6));
            axis.select('.domain').remove();
            if (columns.isNarrow)
                axis.selectAll('text').remove();
        });
    }

    function causesRow(svg, columns, scale, row, top) {
        const labelY = columns.isNarrow ? top + 12 : top + 15;
        const barY = columns.isNarrow ? top + 34 : top + 6, barHeight = columns.isNarrow ? 7 : 11;
        const most = Math.floor((columns.isNarrow ? 1000 : columns.left - 12) / widthOf('x'));
        const name = row.label.length > most ? row.label.slice(0, most - 1) + '…' : row.label;
        svg.append('text').attr('class', 'over').attr('y', labelY)
            .attr('x', columns.isNarrow ? columns.left : columns.left - 12)
            .attr('text-anchor', columns.isNarrow ? 'start' : 'end').text(name);
        row.values.forEach((value, i) => {
            const length = value > 0 ? Math.max(1.5, scale(value)) : 0, at = columns.at(i);
            svg.append('rect').attr('class', 'bar ' + (i ? columns.names[i] : 'whole'))
                .attr('x', at).attr('y', barY).attr('width', length).attr('height', barHeight);
            svg.append('text').attr('class', 'over ' + (row.main === i ? 'strong' : value > 0 ? '' : 'quiet'))
                .attr('x', columns.isNarrow ? at : at + length + 5)
                .attr('y', columns.isNarrow ? top + 29 : labelY).text(row.texts[i]);
        });
    }

    /* What each cause adds: a column of bars for each, all on one logarithmic scale. spec: {width, causes:
     * words, rows}; a row: {label, values, texts: [1 + causes], all of them together first; main: the largest
     * one's place}. */
    function causes(d3, node, spec) {
        const columns = columnsOf(spec);
        const foot = columns.top + spec.rows.length * columns.row + 4;
        const height = foot + (columns.isNarrow ? 26 : 44);
        const svg = begin(d3, node, spec.width, height, 'RMS errors by their causes').attr('role', 'img');
        const values = [].concat(...spec.rows.map(r => r.values)).filter(v => v > 0);
        const scale = errorScale(d3, values, [0, columns.barWidth]).clamp(true);
        causesHead(d3, svg, columns, scale, foot);
        spec.rows.forEach((row, i) => causesRow(svg, columns, scale, row, columns.top + i * columns.row));
        const ends = scale.domain().map(power).join(' to ');
        svg.append('text').attr('class', 'quiet').attr('x', columns.left).attr('y', height - 6)
            .text(columns.isNarrow ? 'RMS errors; bars are logarithmic, ' + ends
                                   : 'RMS errors relative to the mean radiance; bars are logarithmic');
    }

    /* --- files --- */

    /* The text of an SVG file of a plot: by itself it looks as in the page. */
    function fileOf(node, style) {
        const copy = node.cloneNode(true), of = node.ownerDocument.createElementNS(namespace, 'style');
        copy.querySelectorAll('.passing').forEach(one => one.remove());
        of.textContent = style;
        copy.insertBefore(of, copy.firstChild);
        const text = new node.ownerDocument.defaultView.XMLSerializer().serializeToString(copy);
        return '<?xml version="1.0" encoding="UTF-8"?>\n' + text + '\n';
    }

    return { TEXT, front, causes, fileOf };
})();
if (typeof module === 'object')
    module.exports = studyPlots;
