/* The tables of configurations and of claims. shown: what page.js looks at; choose: called with the index of
 * a configuration whose name is clicked. */
var pageTables = function (study, shown, choose) {
    'use strict';

    const { byId, make, fill, words, fillTable } = pageElements, data = studyData;
    const causeWords = data.list(study.causes).map(c => c.name);

    function selector(config) {
        const button = make('button', { type: 'button' }, ...words(config.title));
        button.addEventListener('click', () => choose(config.index));
        return button;
    }

    const nameColumn = { name: 'configuration', kind: 'name', value: c => c.title, show: selector };
    const mostlyColumn = { name: 'mostly', kind: 'text', title: 'the cause that adds most',
                           value: c => c.mainCause, show: c => c.mainCause };

    function timeColumn(key, name, title) {
        const median = config => (data.timeOf(config.times, key) || { median: NaN }).median;
        return { name: name, title: title, kind: 'number', value: median,
                 show: c => data.time(key, median(c)) + (data.isUnstable(c, key) ? ' !' : '') };
    }

    function valueColumn(key, name, title, show) {
        return { name: name, title: title, kind: 'number', value: c => c.values[key],
                 show: c => show(c.values[key]) };
    }

    function screenColumns(configs) {
        const of = c => c.isForScreen ? 'screen' : 'radiance';
        const column = { name: 'errors of', kind: 'text', value: of, show: of };
        return configs.some(c => c.isForScreen) ? [column] : [];
    }

    function rowAttributes(config) {
        return { 'data-index': config.index, class: config.index === shown.selected ? 'selected' : null };
    }

    function all() {
        const columns = [
            nameColumn,
            timeColumn('light_ratio', 'lighting', 'time of lighting over the default’s'),
            timeColumn('light_ms', 'lighting, ms'),
            timeColumn('job_ratio', 'file to file', 'time from file to file over the default’s'),
            timeColumn('job_ms', 'file to file, ms'),
            valueColumn('error_rms', 'RMS', 'root of the mean square', data.error),
            valueColumn('error_p999', '99.9 %', '99.9 % of values are at most this far off', data.error),
            valueColumn('error_max', 'largest', 'the largest error', data.error),
            valueColumn('flip', 'FLIP', 'mean FLIP', data.error),
            valueColumn('psnr', 'PSNR, dB', null, data.amount),
            mostlyColumn,
            ...causeWords.map(w => valueColumn('rms_' + w, w, 'RMS error of ' + w + ' alone', data.error)),
            valueColumn('bytes_stored', 'stored, B/px', 'bytes of a pixel in memory', data.amount),
            valueColumn('bytes_moved', 'moved, B/px', 'bytes per pixel that lighting must move', data.amount),
            valueColumn('bytes_file', 'file, B/px', 'bytes of the G-buffer’s file per pixel', data.amount),
            ...screenColumns(shown.configs),
        ];
        fillTable(byId('all-table'), columns, shown.configs, 1, rowAttributes);
    }

    function front() {
        const error = data.errors.find(e => e.key === shown.errorKey);
        const time = data.times.find(t => t.key === shown.timeKey);
        const columns = [
            { name: 'no.', kind: 'number', value: c => shown.front.indexOf(c),
              show: c => String(shown.front.indexOf(c) + 1) },
            nameColumn,
            timeColumn(time.key, time.name),
            { name: 'interval', kind: 'number', value: c => c.times[time.key].low,
              show: c => data.interval(c.times[time.key], time.key) },
            valueColumn(error.key, error.name, error.title, data.error),
            mostlyColumn,
            ...screenColumns(shown.front),
        ];
        fillTable(byId('front-table'), columns, shown.front, 0, rowAttributes);
    }

    /* "0.2", "0.1 to 0.2". */
    function range(low, high) {
        const text = v => v !== 0 && Math.abs(v) < 1e-3 ? data.error(v) : String(+v.toPrecision(3));
        if (!data.isNumber(low) || !data.isNumber(high))
            return '–';
        return low === high ? text(low) : text(low) + ' to ' + text(high);
    }

    function claimColumns() {
        const theirs = f => data.list(f.theirs);
        return [
            { name: 'what', kind: 'name', value: f => f.what, show: f => f.what || '' },
            { name: 'theirs', kind: 'number', value: f => theirs(f)[0], show: f => range(...theirs(f)) },
            { name: 'ours', kind: 'number', value: f => f.ours, show: f => range(f.ours, f.ours) },
            { name: 'least to largest', kind: 'number', value: f => f.low,
              show: f => f.low === f.high ? '' : range(f.low, f.high) },
            { name: 'unit', kind: 'text', value: f => f.unit, show: f => f.unit || '' },
            { name: 'claim', kind: 'text', title: 'in the order in which they are told', value: f => f.place,
              show: f => f.of },
        ];
    }

    /* What each says, and a row for each of its figures. */
    function claims() {
        const all = data.list(study.claims);
        const figures = (c, i) => data.list(c.figures).map(f => Object.assign({ of: c.name, place: i }, f));
        const rows = [].concat(...all.map(figures));
        const says = c => [make('dt', {}, c.name), make('dd', {}, c.claim || '',
            make('span', { class: 'quiet' }, c.source ? ' (' + c.source + ')' : ''), make('br', {}),
            c.method ? 'Ours: ' + c.method : '')];
        byId('claims').hidden = byId('to-claims').hidden = rows.length === 0;
        fill(byId('claims-list'), ...[].concat(...all.map(says)));
        fillTable(byId('claims-table'), claimColumns(), rows, 5, () => ({}));
    }

    return { all, front, claims };
};
