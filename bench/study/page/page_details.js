/* All figures of one configuration, as elements. */
var pageDetails = function (study, config, number, timeKey) {
    'use strict';

    const { make, words, smallTable } = pageElements, data = studyData, v = config.values;

    function badges() {
        const texts = [[number ? 'no. ' + number + ' of the front' : 'beaten by another', null],
                       [config.isForScreen ? 'errors of what a screen shows' : '', null],
                       [data.isUnstable(config, timeKey) ? '! unstable time' : '', 'alarm']];
        return make('ul', { class: 'badges' },
                    ...texts.filter(t => t[0]).map(t => make('li', { class: t[1] }, t[0])));
    }

    function knobs() {
        const all = data.list(study.knobs).filter(k => k.name in config.knobs);
        const off = all.filter(k => config.knobs[k.name] !== k.usual);
        const usual = all.filter(k => config.knobs[k.name] === k.usual).map(k => k.name + ' ' + k.usual);
        return [make('h4', {}, 'Knobs'),
                ...off.map(k => make('p', {}, k.name + ': ', make('strong', {}, config.knobs[k.name]),
                                     ', not ' + k.usual)),
                usual.length ? make('p', { class: 'quiet' }, 'As usual: ' + usual.join(', ')) : null];
    }

    /* A row for each stage: ms, and over the default's where that is measured. */
    function stages() {
        const keys = Object.keys(config.times).filter(k => /_ms$/.test(k) && data.timeOf(config.times, k));
        const rows = keys.map(key => {
            const stem = key.replace(/_ms$/, ''), of = config.times[key];
            const ratio = data.timeOf(config.times, stem + '_ratio');
            return [stem + (of.unstable ? ' !' : ''), data.amount(of.median), data.interval(of, key),
                    ratio ? data.ratio(ratio.median) : ''];
        });
        return [make('h4', {}, 'Time per stage'), smallTable(['', 'ms', 'interval', '× default'], rows),
                again()];
    }

    /* What a second run said. */
    function again() {
        const of = config.again;
        if (!of || !data.isNumber(of.median))
            return null;
        return make('p', { class: 'quiet' }, 'Measured again: ' + (of.of || 'time').replace(/_/g, ' ') + ' ' +
                    data.time(of.of || '', of.median) + (of.stays === false ? ', outside' : ', inside'));
    }

    function errors() {
        const rows = [
            ['RMS', data.error(v.error_rms)], ['mean', data.error(v.error_mean)],
            ['99.9 % of values, at most', data.error(v.error_p999)], ['largest', data.error(v.error_max)],
            ['PSNR', data.amount(v.psnr) + ' dB'], ['FLIP, mean', data.error(v.flip)],
            ['FLIP, largest', data.error(v.flip_max)], ['values that differ', data.percent(v.differing)],
            ['8-bit codes off, at most', data.amount(v.screen_max)],
            ['channels off by more than 1 code', data.percent(v.screen_beyond)]];
        const of = config.isForScreen ? 'Errors, of a screen' : 'Errors, relative to the mean radiance';
        return [make('h4', {}, of), smallTable(['', ''], rows.filter(r => !/^–/.test(r[1])))];
    }

    function causes() {
        const rows = data.list(study.causes).map(c => c.name).map(w => [
            make('span', {}, make('span', { class: 'dot ' + w }), w),
            data.error(v['rms_' + w]), data.error(v['most_' + w])]);
        return [make('h4', {}, 'By cause'), smallTable(['', 'RMS', 'largest'], rows)];
    }

    function worst() {
        const channel = ['red', 'green', 'blue'][v.worst_channel], of = config.worst;
        if (!data.hasWorst(config))
            return [];
        const why = of.cause ? ', mostly of ' + of.cause + (of.detail ? ': ' + of.detail : '') : '';
        const light = data.isNumber(v.worst_highlight)
            ? ' ' + data.percent(v.worst_highlight) + ' of the light there is highlight.' : '';
        return [make('h4', {}, 'Worst pixel'),
                make('p', {}, 'At ' + v.worst_x + ', ' + v.worst_y + ', ' + channel + ': ' +
                     (+v.worst_got).toPrecision(6) + ' where the reference has ' +
                     (+v.worst_expected).toPrecision(6) + why + '.' + light)];
    }

    function bytes() {
        const names = { bytes_stored: 'stored', bytes_moved: 'moved by lighting', bytes_file: 'file',
                        bytes_picture: 'picture’s file' };
        const known = Object.keys(names).filter(k => data.isNumber(v[k]));
        const rows = known.map(k => [names[k], data.amount(v[k])]);
        return [make('h4', {}, 'Bytes per pixel'), smallTable(['', ''], rows)];
    }

    const groups = [knobs(), stages(), errors(), causes(), worst(), bytes()].filter(g => g.length);
    return [make('h3', {}, ...words(config.title)), badges(),
            make('div', { class: 'groups' }, ...groups.map(g => make('div', { class: 'group' }, ...g)))];
};
