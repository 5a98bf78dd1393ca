// Makes the page of a lesson: node page.mjs NAME PROGRAM OUT.html; or the list of all: node page.mjs index OUT.html. In: the
// program for WebAssembly (lesson_page.c with the lesson), docs/lessons/NAME. Out: one HTML file that needs no other, to be
// opened from the file system. The text comes from cmark-gfm.
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

const here = dirname(fileURLToPath(import.meta.url)), lessons = join(here, '../../docs/lessons');
const read = (...path) => readFileSync(join(...path), 'utf8');
const escape = text => text.replace(/[&<>"]/g, letter => `&#${letter.charCodeAt(0)};`);

/** The lessons in their order, each with its subject: the rows of the table of docs/lessons/README.md. */
const all = [...read(lessons, 'README.md').matchAll(/^\| \[(\w+)\]\(\w+\/README\.md\) \| (.*) \|$/gm)]
    .map(([, name, about]) => ({ name, about }));

/** The hash of the native program's picture: exercise 0 of the table of answers. */
const native_hash = name => new RegExp(`"${name}", 0, IS_PICTURE, 0x([0-9a-f]{16})`).exec(
    read(here, '../cli/lesson_answers.h'))[1];

/** Links to other lessons lead to their pages, those to the program to its text below; others lead out of the page. */
function follow(text, name) {
    return text.replace(/<a href="([^"]*)">(.*?)<\/a>/gs, (link, to, words) => {
        const [, other, file] = /^(?:\.\.\/(\w+)\/|)([\w.]*)(?:#.*)?$/.exec(to) ?? [];
        const page = other === undefined || other === name ? '' : `${other}.html`;
        if (/^https?:/.test(to) || /^#/.test(to)) return link;
        if (file === undefined || (page !== '' && !all.some(lesson => lesson.name === other))) return words;
        return file === 'README.md' ? `<a href="${page}">${words}</a>`
            : file === `${other ?? name}.c` ? `<a href="${page}#source">${words}</a>` : words;
    });
}

/** The lesson's text without its picture, which is drawn; and what the picture shows. */
function make_text(name) {
    const html = execFileSync('cmark-gfm', ['--unsafe', '-e', 'table', join(lessons, name, 'README.md')], { encoding: 'utf8' });
    const image = new RegExp(`<p><img src="${name}\\.png" alt="([^"]*)" /></p>\\n`);
    const pictures = html.replace(image, '').replace(/<img src="([^":]*)"/g, (tag, file) =>
        `<img src="data:image/png;base64,${readFileSync(join(lessons, name, file)).toString('base64')}"`);
    return { text: follow(pictures, name), alt: image.exec(html)?.[1] ?? name };
}

function make_nav(name) {
    const at = all.findIndex(lesson => lesson.name === name), links = ['<a href="index.html">lessons</a>'];
    if (at > 0) links.push(`<a href="${all[at - 1].name}.html">◀ ${all[at - 1].name}</a>`);
    if (at >= 0 && at + 1 < all.length) links.push(`<a href="${all[at + 1].name}.html">${all[at + 1].name} ▶</a>`);
    return links.join(' · ');
}

/** The worker is one script, since pages from files may start no worker that is a module: what it imports stands before it. */
const make_worker = () => (read(here, 'wasi.mjs') + read(here, 'page_worker.mjs')).replace(/^import .*$|^export /gm, '');

function make_page(name, program) {
    const png = readFileSync(join(lessons, name, `${name}.png`)), hash = native_hash(name);
    const parts = {
        ...make_text(name), name, nav: make_nav(name), title: `lom: ${name}`, source: escape(read(lessons, name, `${name}.c`)),
        width: png.readUInt32BE(16), height: png.readUInt32BE(20), known: JSON.stringify({ name, hash }),
        program: gzipSync(readFileSync(program), { level: 9 }).toString('base64'),
        worker: make_worker(), view: read(here, 'page_view.js'),
    };
    return read(here, 'page.html').replace(/\{\{(\w+)\}\}/g, (mark, part) => parts[part]);
}

function make_index(folder) {
    const rows = all.map(({ name, about }) => existsSync(join(folder, `${name}.html`))
        ? `<li><a href="${name}.html">${name}</a>: ${escape(about)}</li>` : '');
    return `<!DOCTYPE html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>lom: lessons</title><body style="font:16px/1.6 sans-serif;max-width:45em;margin:2em auto;padding:0 1em">
<h1>Lessons</h1><p>Each page draws its picture itself, by the lesson's own program.</p><ol>${rows.join('\n')}</ol></body></html>\n`;
}

const [name, ...files] = process.argv.slice(2);
writeFileSync(files.at(-1), name === 'index' ? make_index(dirname(files[0])) : make_page(name, files[0]));
