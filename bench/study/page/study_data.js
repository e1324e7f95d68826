/* What a study says: of study.json, by names that it brings along itself. What is missing is told as not
 * known, and what is new has a place: knobs, times, values and causes are read from its tables. */
var studyData = (function () {
    'use strict';

    /* What may be on the axes. */
    const errors = [
        { key: 'error_rms', name: 'RMS', title: 'RMS error' },
        { key: 'error_p999', name: '99.9 %', title: 'Error that 99.9 % of values keep to' },
        { key: 'error_max', name: 'largest', title: 'Largest error' },
        { key: 'flip', name: 'FLIP', title: 'Mean FLIP' },
    ];
    const times = [
        { key: 'light_ratio', name: 'lighting, over the default',
          title: 'Time of lighting over the default’s', isRatio: true },
        { key: 'light_ms', name: 'lighting, ms', title: 'Time of lighting, ms', isRatio: false },
        { key: 'job_ratio', name: 'file to file, over the default',
          title: 'Time from file to file over the default’s', isRatio: true },
        { key: 'job_ms', name: 'file to file, ms', title: 'Time from file to file, ms', isRatio: false },
    ];

    function isNumber(value) {
        return typeof value === 'number' && isFinite(value);
    }

    /* --- numbers as text --- */

    function error(value) {
        return !isNumber(value) ? '–' : value === 0 ? '0' : value.toExponential(1);
    }

    /* Three digits. */
    function amount(value) {
        if (!isNumber(value))
            return '–';
        if (Number.isInteger(value))
            return String(value);
        const size = Math.abs(value);
        return value.toFixed(size >= 100 ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : 3);
    }

    function ratio(value) {
        return !isNumber(value) ? '–' : value.toFixed(Math.abs(value) >= 10 ? 1 : 2);
    }

    function percent(share) {
        if (!isNumber(share))
            return '–';
        const value = 100 * share;
        const isTiny = value !== 0 && value < 0.01;
        return (isTiny ? value.toExponential(0) : String(+value.toPrecision(2))) + ' %';
    }

    function time(key, value) {
        return /_ratio$/.test(key) ? ratio(value) : amount(value);
    }

    /* Of a time that was measured, and is not known without. */
    function interval(of, key) {
        return of.samples > 0 ? time(key, of.low) + ' to ' + time(key, of.high) : '';
    }

    /* --- configurations --- */

    function list(value) {
        return Array.isArray(value) ? value : [];
    }

    function timeOf(times, key) {
        const of = times && times[key];
        return of && isNumber(of.median) ? of : null;
    }

    /* A word alone says enough, unless it is a number, stands for several knobs, or is a form of some
     * formula. */
    function saysEnough(word, knob, knobs) {
        return !/^[0-9.]/.test(word) && knob.cause !== 'approximation' &&
            knobs.filter(k => String(k.words || '').split(',').includes(word)).length === 1;
    }

    /* "merlin + png", "cutoff 1e-3": what is not usual, shorter than the title. */
    function shortLabel(of, knobs) {
        const words = of.knobs || {};
        const parts = knobs.filter(k => k.name in words && words[k.name] !== k.usual)
            .map(k => saysEnough(words[k.name], k, knobs) ? words[k.name] : k.name + ' ' + words[k.name]);
        return parts.length ? parts.join(' + ') : of.title || 'default';
    }

    function hasUsualFiles(of, knobs) {
        return knobs.every(k => !k.of_files || !of.knobs || !(k.name in of.knobs) ||
                                of.knobs[k.name] === k.usual);
    }

    /* Configurations of a frame, each with `index`, its place in the study. */
    function configurations(study, frame) {
        const knobs = list(study.knobs);
        return list(frame.configurations).map((of, index) => ({
            index: index,
            title: of.title || 'configuration ' + index,
            label: shortLabel(of, knobs),
            knobs: of.knobs || {},
            times: of.times || {},
            values: of.values || {},
            isForScreen: of.errors_of === 'screen',
            hasUsualFiles: hasUsualFiles(of, knobs),
            isUsual: knobs.every(k => !of.knobs || of.knobs[k.name] === k.usual),
            isUnstable: of.unstable === true,
            again: of.again || null,
            mainCause: of.main_cause || 'none',
            worst: of.worst || {},
            map: of.map || '',
        }));
    }

    function hasWorst(config) {
        const v = config.values;
        return isNumber(v.worst_x) && isNumber(v.worst_y) && v.error_max > 0;
    }

    function isUnstable(config, timeKey) {
        const of = timeOf(config.times, timeKey);
        return config.isUnstable || (of !== null && of.unstable === true);
    }

    /* --- fronts: the rule of bench/study/front.h, for any error and any time --- */

    function competes(config, errorKey, timeKey) {
        return timeOf(config.times, timeKey) !== null && isNumber(config.values[errorKey]) &&
            (config.hasUsualFiles || !/^light/.test(timeKey));
    }

    function beats(a, b, errorKey, timeKey) {
        const timeA = a.times[timeKey].median, timeB = b.times[timeKey].median;
        const errorA = a.values[errorKey], errorB = b.values[errorKey];
        return a.isForScreen === b.isForScreen && timeA <= timeB && errorA <= errorB &&
            (timeA < timeB || errorA < errorB || a.index < b.index);
    }

    /* What none beats, from the fastest on. */
    function front(configs, errorKey, timeKey) {
        const all = configs.filter(c => competes(c, errorKey, timeKey));
        return all.filter(one => !all.some(other => other !== one && beats(other, one, errorKey, timeKey)))
            .sort((a, b) => a.times[timeKey].median - b.times[timeKey].median || a.index - b.index);
    }

    /* --- findings: a sentence each; what stands between ** is the finding's figure --- */


    function fastestWithin(configs, limit) {
        return front(configs, 'error_rms', 'light_ratio')
            .find(c => !c.isForScreen && c.values.error_rms <= limit);
    }

    function howFast(config) {
        const of = config.times.light_ratio, ms = timeOf(config.times, 'light_ms');
        const inMs = ms ? amount(ms.median) + ' ms' : '';
        if (config.isUsual)
            return inMs;
        const isSure = !(of.samples > 0) || of.high < 1 || of.low > 1;
        const range = interval(of, 'light_ratio');
        return '**' + ratio(of.median) + '** of the default’s time' + (range && ' (' + range + ')') +
            (inMs && ', ' + inMs) +
            (isSure ? '' : '; the interval holds 1, so that it may be no faster than the default');
    }

    function budgets(configs) {
        const said = [];
        for (const limit of [1e-6, 1e-4, 1e-2]) {
            const best = fastestWithin(configs, limit), last = said[said.length - 1];
            if (last && last.best === best)
                last.limits.push(limit);
            else
                said.push({ best: best, limits: [limit] });
        }
        return said.map(s => {
            const limits = s.limits.map(l => l.toExponential(0)).join(' or ');
            const best = s.best && (s.best.isUsual ? 'the **default**' : '**' + s.best.label + '**');
            return 'Within an RMS error of ' + limits +
                (best ? ', ' + best + ' is fastest: ' + howFast(s.best) + '.'
                      : ', nothing that was measured will do.');
        });
    }

    function extent(configs) {
        const on = front(configs, 'error_rms', 'light_ratio').filter(c => !c.isForScreen);
        if (on.length < 2)
            return [];
        const first = on[0], last = on[on.length - 1];
        return ['**' + on.length + ' of ' + configs.length + '** configurations are beaten by no other in ' +
                'time and error; from the fastest to the most accurate, RMS errors go from ' +
                error(first.values.error_rms) + ' to ' + error(last.values.error_rms) + ', times from ' +
                ratio(first.times.light_ratio.median) + ' to ' + ratio(last.times.light_ratio.median) +
                ' of the default’s.'];
    }

    function causes(configs) {
        const counts = {};
        configs.forEach(c => { counts[c.mainCause] = (counts[c.mainCause] || 0) + 1; });
        const order = Object.keys(counts).filter(c => c !== 'none').sort((a, b) => counts[b] - counts[a]);
        if (order.length === 0)
            return [];
        const first = order[0][0].toUpperCase() + order[0].slice(1);
        const rest = order.slice(1).map(c => '; ' + c + ' in ' + counts[c]).join('');
        return ['**' + first + '** is the largest part of the error in ' + counts[order[0]] + ' of ' +
                configs.length + ' configurations' + rest + '.'];
    }

    /* Pairs that differ by double arithmetic alone, and have something packed besides. */
    function doublePairs(configs) {
        const key = c => JSON.stringify(Object.assign({}, c.knobs, { precision: 'double' }));
        const doubles = configs.filter(c => c.knobs.precision === 'double');
        return doubles.map(d => ({ double: d, float: configs.find(c => c !== d && key(c) === key(d)) }))
            .filter(p => p.float && p.float.mainCause === 'storage' &&
                         isNumber(p.float.values.error_rms) && isNumber(p.double.values.error_rms));
    }

    function doubleOnPacked(configs) {
        const pairs = doublePairs(configs);
        const gains = p => p.float.values.error_rms / p.double.values.error_rms - 1;
        const idle = pairs.filter(p => Math.abs(gains(p)) < 0.01 && timeOf(p.double.times, 'light_ratio') &&
                                       timeOf(p.float.times, 'light_ratio'));
        if (idle.length === 0)
            return [];
        const cost = idle.map(p => p.double.times.light_ratio.median / p.float.times.light_ratio.median);
        const most = cost.length > 1 ? ' to ' + ratio(Math.max(...cost)) : '';
        return ['Where storage dominates, double arithmetic buys nothing in **' + idle.length + ' of ' +
                pairs.length + '** cases: the RMS error changes by less than 1 %, at ' +
                ratio(Math.min(...cost)) + most + ' times the time.'];
    }

    function culling(configs) {
        const known = configs.filter(c => isNumber(c.values.culling_differing));
        const changed = known.filter(c => c.values.culling_differing > 0);
        if (known.length === 0)
            return [];
        return [changed.length
            ? 'Culling changes the picture in **' + changed.length + '** configurations: that is a fault.'
            : 'Culling adds **no error**: it changes no bit in any of ' + known.length + ' configurations.'];
    }

    function stability(study, configs) {
        const said = [], load = study.machine && study.machine.load_before;
        const count = configs.filter(c => isUnstable(c, 'light_ratio')).length;
        if (count)
            said.push('**' + count + ' of ' + configs.length + '** times of lighting are unstable: they ' +
                      'drifted while they were measured, or came out elsewhere when measured again. An ' +
                      'exclamation mark stands beside them.');
        const twice = configs.filter(c => c.again && typeof c.again.stays === 'boolean');
        if (twice.length)
            said.push('Measured a second time, **' + twice.filter(c => c.again.stays).length + ' of ' +
                      twice.length + '** came out inside the intervals that the first run states.');
        if (load > 0.5)
            said.push('Other work ran when the study began (a load of ' + load.toFixed(1) +
                      '), so intervals are wide.');
        return said;
    }

    function findings(study, configs) {
        return [].concat(budgets(configs), extent(configs), causes(configs),
                         doubleOnPacked(configs), culling(configs), stability(study, configs));
    }

    /* --- for study_plots.js --- */

    /* What its `front` takes, but for the width; shown: {configs, front, errorKey, timeKey}. */
    function frontSpec(shown) {
        const of = errors.find(e => e.key === shown.errorKey);
        const over = times.find(t => t.key === shown.timeKey);
        return {
            error: of, time: over, xTitle: over.title, isRatio: over.isRatio,
            yTitle: of.title + (of.key === 'flip' ? '' : ', relative to the mean radiance'),
            points: shown.configs.map(c => ({
                index: c.index, label: c.label, says: c.title, cause: c.mainCause,
                x: timeOf(c.times, over.key), y: c.values[of.key], isForScreen: c.isForScreen,
                isUnstable: isUnstable(c, over.key), number: shown.front.indexOf(c) + 1 })),
        };
    }

    /* What its `causes` takes, but for the width. */
    function causesSpec(study, configs) {
        const words = list(study.causes).map(c => c.name);
        const valuesOf = c => [c.values.error_rms].concat(words.map(w => c.values['rms_' + w]));
        return {
            causes: words,
            rows: configs.map(c => ({ label: c.label, values: valuesOf(c), texts: valuesOf(c).map(error),
                                      main: 1 + words.indexOf(c.mainCause) })),
        };
    }

    return { errors, times, isNumber, error, amount, ratio, percent, time, interval, list, timeOf,
             configurations, hasWorst, isUnstable, front, findings, frontSpec, causesSpec };
})();
if (typeof module === 'object')
    module.exports = studyData;
