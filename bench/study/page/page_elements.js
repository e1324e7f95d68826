/* Elements and tables that sort. */
var pageElements = (function () {
    'use strict';

    const byId = id => document.getElementById(id);
    const isThere = value => value !== null && value !== undefined;

    /* An element with attributes; what is in it are elements or texts. What is null is left out. */
    function make(name, attributes, ...inside) {
        const one = document.createElement(name);
        Object.keys(attributes).filter(key => isThere(attributes[key]))
            .forEach(key => one.setAttribute(key, attributes[key]));
        one.append(...inside.filter(isThere));
        return one;
    }

    function fill(node, ...inside) {
        node.replaceChildren(...inside.filter(isThere));
    }

    /* What stands between two pairs of asterisks is strong. */
    function sentence(name, text) {
        return make(name, {}, ...text.split('**').map((part, i) => i % 2 ? make('strong', {}, part) : part));
    }

    function fillSelect(node, options, chosen) {
        fill(node, ...options.map(o => make('option', { value: o.value }, o.text)));
        node.value = chosen;
    }

    /* Words that are broken between, not inside. */
    function words(text) {
        const parts = text.split(' ').map(word => make('span', { class: 'word' }, word));
        return parts.reduce((all, part) => all.concat(all.length ? [' ', part] : [part]), []);
    }

    /* What is not known stands last, whichever way. */
    function compare(a, b, sign) {
        const isMissing = v => !isThere(v) || v === '' || Number.isNaN(v);
        if (isMissing(a) || isMissing(b))
            return isMissing(a) - isMissing(b);
        if (typeof a === 'number' && typeof b === 'number')
            return sign * (a - b);
        return sign * String(a).localeCompare(String(b), 'en', { numeric: true });
    }

    function rowOf(columns, row, attributesOf) {
        const cells = columns.map(c => c.kind === 'name' ? make('th', { scope: 'row' }, c.show(row))
                                                         : make('td', { class: c.kind }, c.show(row)));
        return make('tr', attributesOf(row), ...cells);
    }

    /* columns: {name, title, kind: 'number', 'text' or 'name', value: row -> what to sort by, show: row ->
     * text or element}. sorted: the place of the column that sorts rows at first. attributesOf: row ->
     * those of its element. */
    function fillTable(table, columns, rows, sorted, attributesOf) {
        const body = make('tbody', {}), heads = columns.map(column => {
            const button = make('button', { type: 'button', title: column.title }, column.name);
            const head = make('th', { scope: 'col', class: column.kind }, button);
            button.addEventListener('click', () => sort(column, head));
            return head;
        });
        function sort(column, head) {
            const isUp = head.getAttribute('aria-sort') !== 'ascending', sign = isUp ? 1 : -1;
            heads.forEach(h => h.removeAttribute('aria-sort'));
            head.setAttribute('aria-sort', isUp ? 'ascending' : 'descending');
            const order = rows.slice().sort((a, b) => compare(column.value(a), column.value(b), sign));
            fill(body, ...order.map(row => rowOf(columns, row, attributesOf)));
        }
        fill(table, make('thead', {}, make('tr', {}, ...heads)), body);
        sort(columns[sorted], heads[sorted]);
    }

    /* One that does not sort; the first of each row is its head. */
    function smallTable(heads, rows) {
        const head = heads.map((h, i) => make('th', { scope: 'col', class: i ? 'number' : null }, h));
        const body = rows.map(r => make('tr', {}, ...r.map((cell, i) =>
            i ? make('td', { class: 'number' }, cell) : make('th', { scope: 'row' }, cell))));
        return make('table', {}, heads.some(h => h) ? make('thead', {}, make('tr', {}, ...head)) : null,
                    make('tbody', {}, ...body));
    }

    return { byId, make, fill, sentence, fillSelect, words, fillTable, smallTable };
})();
