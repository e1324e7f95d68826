/* The front: drawn anew for other axes and widths, and gone about in by pointer and by keys. shown: what
 * page.js looks at; select: called with the index of the configuration that is gone to. */
var pageFront = function (shown, select) {
    'use strict';

    const { byId } = pageElements, data = studyData, node = byId('front-plot'), room = byId('front-room');
    let places = []; /* where points stand, by index; px */

    function says(config, error, time) {
        const of = data.timeOf(config.times, time.key), number = shown.front.indexOf(config) + 1;
        return config.title + ': ' + time.name + ' ' + (of ? data.time(time.key, of.median) : 'not known') +
            ', ' + error.title + ' ' + data.error(config.values[error.key]) + ', mostly ' + config.mainCause +
            (number ? ', number ' + number + ' of the front' : '') +
            (data.isUnstable(config, time.key) ? ', unstable time' : '');
    }

    function draw() {
        const hadFocus = node.contains(document.activeElement), spec = data.frontSpec(shown);
        spec.width = Math.max(300, Math.floor(room.clientWidth));
        spec.points.forEach((p, i) => { p.says = says(shown.configs[i], spec.error, spec.time); });
        places = studyPlots.front(d3, node, spec);
        const svg = d3.select(node).attr('role', 'group');
        svg.select('.points').attr('role', 'listbox')
            .attr('aria-label', 'Configurations; the arrow keys go from one to the next');
        svg.selectAll('.point').attr('role', 'option');
        svg.append('circle').attr('class', 'ring hovered passing').attr('r', 0);
        svg.append('circle').attr('class', 'ring selected passing').attr('r', 12);
        mark();
        if (hadFocus)
            focus();
    }

    /* The one that is selected is where the Tab key enters. */
    function mark() {
        const at = places[shown.selected];
        node.querySelectorAll('.point').forEach(point => {
            const is = +point.dataset.index === shown.selected;
            point.setAttribute('aria-selected', is);
            point.setAttribute('tabindex', is ? 0 : -1);
        });
        if (at)
            d3.select(node).select('.ring.selected').attr('cx', at.x).attr('cy', at.y);
    }

    function focus() {
        node.querySelector('.point[aria-selected="true"]').focus({ preventScroll: true });
    }

    function go(index) {
        select(index);
        focus();
    }

    /* The point drawn nearest to where the pointer is; -1: none is near. */
    function nearest(event) {
        const box = node.getBoundingClientRect(), reach = 28;
        const away = at => Math.hypot(at.x - (event.clientX - box.left), at.y - (event.clientY - box.top));
        const index = d3.scan(places, (a, b) => away(a) - away(b));
        return index !== undefined && away(places[index]) < reach ? index : -1;
    }

    function hover(event) {
        const index = event.type === 'pointerleave' ? -1 : nearest(event), svg = d3.select(node);
        const at = places[index] || { x: 0, y: 0 }, isLeft = at.x > room.clientWidth / 2;
        svg.style('cursor', index < 0 ? 'default' : 'pointer');
        svg.select('.ring.hovered').attr('r', index < 0 ? 0 : 10).attr('cx', at.x).attr('cy', at.y);
        svg.selectAll('.hover-text').remove();
        if (index >= 0)
            svg.append('text').attr('class', 'hover-text passing strong over')
                .attr('x', at.x + (isLeft ? -14 : 14)).attr('y', at.y - 10)
                .attr('text-anchor', isLeft ? 'end' : 'start').text(shown.configs[index].label);
    }

    /* By arrow keys: the next in time, or in error; equals stand one after the other. Home: the fastest. */
    function neighbour(key) {
        const isX = key !== 'ArrowUp' && key !== 'ArrowDown';
        const step = key === 'ArrowLeft' || key === 'ArrowUp' ? -1 : 1;
        const order = places.map((at, index) => index).sort((a, b) => {
            const p = places[a], q = places[b];
            return (isX ? p.x - q.x || p.y - q.y : p.y - q.y || p.x - q.x) || a - b;
        });
        if (key === 'Home' || key === 'End')
            return order[key === 'Home' ? 0 : order.length - 1];
        return order[order.indexOf(shown.selected) + step];
    }

    function onKey(event) {
        const keys = ['ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown', 'Home', 'End'];
        if (!keys.includes(event.key) || event.ctrlKey || event.altKey || event.metaKey)
            return;
        event.preventDefault();
        const next = neighbour(event.key);
        if (next !== undefined)
            go(next);
    }

    node.addEventListener('keydown', onKey);
    node.addEventListener('pointermove', hover);
    node.addEventListener('pointerleave', hover);
    node.addEventListener('click', event => {
        const index = nearest(event);
        if (index >= 0)
            go(index);
    });
    return { draw, mark };
};
