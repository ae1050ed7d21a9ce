// SPDX-License-Identifier: GPL-3.0-only
'use strict';

// ---- Tables: a click on a column's heading sorts by it ------------------------------------------

// Numbers are sorted by their exact value, all else by its text. What is neither comes last.
function sortKey(cell, isNumeric) {
    if (isNumeric) {
        const value = cell.querySelector('data')?.value ?? 'nan';
        return value === 'inf' ? Infinity : Number(value);
    }
    const text = cell.innerText.trim();
    return text === '–' ? '' : text;
}

function isMissing(key) {
    return key === '' || Number.isNaN(key);
}

function compare(a, b) {
    if (typeof a === 'string')
        return a.localeCompare(b, 'en', {numeric: true});
    return a < b ? -1 : a > b ? 1 : 0;
}

function sortBy(heading) {
    const body = heading.closest('table').tBodies[0];
    const sign = heading.getAttribute('aria-sort') === 'ascending' ? -1 : 1;
    const cellOf = row => row.cells[heading.cellIndex];
    const isNumeric = heading.classList.contains('number');
    const keyed = [...body.rows].map(row => ({row, key: sortKey(cellOf(row), isNumeric)}));
    const [missing, sorted] = [keyed.filter(({key}) => isMissing(key)),
                               keyed.filter(({key}) => !isMissing(key))];
    sorted.sort((a, b) => sign * compare(a.key, b.key));
    body.append(...[...sorted, ...missing].map(({row}) => row));
    for (const other of heading.parentElement.cells)
        other.setAttribute('aria-sort', 'none');
    heading.setAttribute('aria-sort', sign > 0 ? 'ascending' : 'descending');
}

for (const heading of document.querySelectorAll('thead th'))
    heading.querySelector('button').addEventListener('click', () => sortBy(heading));

// ---- Images: two of them with a movable line between, in turns, or their difference ------------

function pixels(image) {
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [image.naturalWidth, image.naturalHeight];
    const context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    return context.getImageData(0, 0, canvas.width, canvas.height);
}

// Draws |a - b| times a factor, channel by channel; returns the number of pixels that differ.
function drawDifference(canvas, a, b, factor) {
    const [difference, other] = [pixels(a), pixels(b)];
    const [data, subtracted] = [difference.data, other.data];
    let differing = 0;
    for (let i = 0; i < data.length; i += 4) {
        let sum = 0;
        for (let channel = i; channel < i + 3; ++channel) {
            const distance = Math.abs(data[channel] - subtracted[channel]);
            data[channel] = factor * distance;  // clamped to 255
            sum += distance;
        }
        differing += sum > 0;
    }
    [canvas.width, canvas.height] = [difference.width, difference.height];
    canvas.getContext('2d').putImageData(difference, 0, 0);
    return differing;
}

function zoomTo(factor, stage, frame, image) {
    const centre = [(frame.scrollLeft + frame.clientWidth / 2) / stage.clientWidth,
                    (frame.scrollTop + frame.clientHeight / 2) / stage.clientHeight];
    stage.style.width = factor > 0 ? `${factor * image.naturalWidth}px` : '';
    frame.scrollLeft = centre[0] * stage.clientWidth - frame.clientWidth / 2;
    frame.scrollTop = centre[1] * stage.clientHeight - frame.clientHeight / 2;
}

function startComparison(form) {
    const {a, b, zoom, view, line, factor, flip} = form.elements;
    const frame = form.querySelector('.window');
    const stage = form.querySelector('.stage');
    const images = [...stage.querySelectorAll('img')];
    const canvas = stage.querySelector('canvas');
    const mark = stage.querySelector('.line');
    let isFlipped = false;

    function show() {
        const [first, second] = [a, b].map(select => select.selectedOptions[0]);
        const [imageA, imageB] = [images[first.value], images[second.value]];
        const top = view.value === 'flip' && !isFlipped ? imageA : imageB;
        const isVisible = {
            slider: image => image === imageA || image === imageB,
            flip: image => image === top,
            difference: () => false,
        }[view.value];
        for (const image of images) {
            image.hidden = !isVisible(image);
            image.style.zIndex = image === top ? 1 : 0;
            const isClipped = view.value === 'slider' && image === imageB && imageA !== imageB;
            image.style.clipPath = isClipped ? `inset(0 0 0 ${line.value}%)` : '';
        }
        canvas.hidden = view.value !== 'difference';
        mark.hidden = view.value !== 'slider';
        mark.style.left = `${line.value}%`;
        mark.style.zIndex = 2;
        for (const control of form.querySelectorAll('[data-view]'))
            control.hidden = control.dataset.view !== view.value;
        const sentence = {
            slider: () => `Left of the line: ${first.text}; right of it: ${second.text}.`,
            flip: () => `Shown: ${isFlipped ? `B, ${second.text}` : `A, ${first.text}`}.`,
            difference: () => {
                const differing = drawDifference(canvas, imageA, imageB, factor.value);
                const count = canvas.width * canvas.height;
                return `|${first.text} − ${second.text}| of the displayed sRGB values, times ` +
                    `${factor.value}: ${differing} of ${count} pixels differ.`;
            },
        }[view.value]();
        const sentences = new Set([sentence, first.dataset.differs, second.dataset.differs]);
        form.querySelector('.shown').innerText = [...sentences].join(' ');
    }

    function flipOver() {
        isFlipped = !isFlipped;
        show();
    }

    function moveLine(event) {
        if (view.value === 'slider' && event.buttons & 1) {
            line.value = 100 * event.offsetX / stage.clientWidth;
            show();
        }
    }

    form.addEventListener('input', show);  // while the line moves
    form.addEventListener('change', show);
    form.addEventListener('submit', event => event.preventDefault());
    flip.addEventListener('click', flipOver);
    frame.style.aspectRatio = images[0].naturalWidth / images[0].naturalHeight;  // at each zoom
    zoom.addEventListener('change', () => zoomTo(Number(zoom.value), stage, frame, images[0]));
    stage.addEventListener('pointerdown', moveLine);
    stage.addEventListener('pointermove', moveLine);
    stage.addEventListener('click', () => view.value === 'flip' && flipOver());
    frame.addEventListener('keydown', event => {
        if (event.key === ' ' && view.value === 'flip') {
            event.preventDefault();
            flipOver();
        }
    });
    show();
}

addEventListener('load', () => {  // images have their sizes then
    document.querySelectorAll('form.comparison').forEach(startComparison);
});
