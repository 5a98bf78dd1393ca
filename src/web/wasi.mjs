// WebAssembly's system interface (WASI preview 1), as much of it as lom calls. In: a compiled module, its arguments and a
// system: the files, streams and clocks that are there (lom.mjs has those of node). Out: the status that the program ends
// with. Invariants: the memory is looked at anew in every call, since it moves when it grows; a file is read whole when it
// is opened, and written whole when it is flushed or closed. Numbers and layouts: WebAssembly/WASI, preview1 docs.md.

const ERRORS = {
    EACCES: 2, EBADF: 8, EBUSY: 10, EEXIST: 20, EFBIG: 22, EINVAL: 28, EIO: 29, EISDIR: 31, ELOOP: 32, EMFILE: 33,
    ENAMETOOLONG: 37, ENOENT: 44, ENOSPC: 51, ENOTDIR: 54, ENOTEMPTY: 55, ENOTSUP: 58, EPERM: 63, EPIPE: 64, EROFS: 69,
    ESPIPE: 70, EXDEV: 75,
};
export const TERMINAL = 2, FOLDER = 3, FILE = 4, LINK = 7; // types of files; 0 is any other
const CREATE = 1, ONLY_FOLDER = 2, EXCLUSIVE = 4, TRUNCATE = 8;
const READ = 1n << 1n, SEEK = 1n << 2n, TELL = 1n << 5n, WRITE = 1n << 6n, ALL = (1n << 29n) - 1n; // rights

class Exit {
    constructor(status) {
        this.status = status;
    }
}

export function fail(code) {
    throw Object.assign(new Error(code), { code });
}

/** Runs _start of the module; gives its exit status. */
export function run(module, args, system) {
    let memory;
    const view = () => new DataView(memory.buffer);
    const bytes = (at, size) => new Uint8Array(memory.buffer, at, size);
    const text = (at, size) => new TextDecoder().decode(bytes(at, size));
    const put32 = (at, value) => view().setUint32(at, value, true);
    const put64 = (at, value) => view().setBigUint64(at, BigInt(value), true);
    const put = (at, size, source) => bytes(at, size).set(source.subarray(0, size));

    const ROOT = 3; // the folder that is open from the start
    const open = [0, 1, 2].map(stream => ({ stream, kind: system.terminal(stream) ? TERMINAL : 0 }));
    open[ROOT] = { path: '/', kind: FOLDER };
    const at = number => open[number] ?? fail('EBADF');
    const path = (folder, text_at, size) => `${at(folder).path ?? fail('ENOTDIR')}/${text(text_at, size)}`.replace(/^\/+/, '/');
    const words = list => list.map(word => new TextEncoder().encode(word + '\0'));
    const argument_words = words(args), environment_words = words([`PWD=${system.folder()}`]);
    const put_sizes = list => (count_at, size_at) => {
        put32(count_at, list.length);
        put32(size_at, list.reduce((sum, word) => sum + word.length, 0));
    };
    const put_words = list => (table, to) => list.forEach((word, i) => {
        put32(table + 4 * i, to);
        bytes(to, word.length).set(word);
        to += word.length;
    });

    const put_status = (to, { kind, size, device, number, changed }) => {
        bytes(to, 64).fill(0);
        [[0, device], [8, number], [24, 1], [32, size], [40, changed], [48, changed], [56, changed]].forEach(
            ([offset, value]) => put64(to + offset, value));
        view().setUint8(to + 16, kind);
    };
    const status_or_null = name => {
        try {
            return system.status(name, true);
        } catch (error) {
            return error.code === 'ENOENT' ? null : fail(error.code);
        }
    };
    const open_file = (name, follow, flags, rights) => {
        if (!follow && status_or_null(name) !== null && system.status(name, false).kind === LINK) fail('ELOOP');
        let status = status_or_null(name);
        if (status !== null && flags & EXCLUSIVE) fail('EEXIST');
        if (status === null && !(flags & CREATE)) fail('ENOENT');
        if (status !== null && flags & ONLY_FOLDER && status.kind !== FOLDER) fail('ENOTDIR');
        if (status?.kind === FOLDER) return rights & WRITE && !(flags & ONLY_FOLDER) ? fail('EISDIR') : { path: name, kind: FOLDER };
        const empty = status === null || Boolean(flags & TRUNCATE);
        if (empty) system.write(name, new Uint8Array(), Boolean(flags & EXCLUSIVE));
        const content = empty || !(rights & READ) ? new Uint8Array() : system.read(name);
        status ??= system.status(name, true);
        return { path: name, ...status, content, size: content.length, position: 0, writes: Boolean(rights & WRITE), dirty: false };
    };
    const flush = file => {
        if (file.dirty) system.write(file.path, file.content.subarray(0, file.size), false);
        file.dirty = false;
    };
    const read = (file, to) => {
        if (file.stream !== undefined) return system.input(to);
        if (file.content === undefined) fail('EISDIR');
        const from = file.content.subarray(file.position, Math.min(file.size, file.position + to.length));
        to.set(from);
        file.position += from.length;
        return from.length;
    };
    const write = (file, from) => {
        if (file.stream !== undefined) return system.output(file.stream, from);
        if (!file.writes) fail('EBADF');
        const end = file.position + from.length;
        if (end > file.content.length) {
            const larger = new Uint8Array(Math.max(end, 2 * file.content.length, 4096));
            larger.set(file.content.subarray(0, file.size));
            file.content = larger;
        }
        file.content.set(from, file.position);
        file.position = end;
        file.size = Math.max(file.size, end);
        file.dirty = true;
        return from.length;
    };
    /** A list of count pieces (address, size), each given to call until one is not used up. */
    const each_piece = (call, number, list, count, total_at) => {
        let total = 0;
        for (let i = 0; i < count; i++) {
            const size = view().getUint32(list + 8 * i + 4, true);
            const used = size ? call(at(number), bytes(view().getUint32(list + 8 * i, true), size)) : 0;
            total += used;
            if (used < size) break;
        }
        put32(total_at, total);
    };

    const calls = {
        args_sizes_get: put_sizes(argument_words),
        args_get: put_words(argument_words),
        environ_sizes_get: put_sizes(environment_words),
        environ_get: put_words(environment_words),
        clock_time_get: (clock, precision, to) => put64(to, system.now(clock === 0)),
        random_get: (to, size) => system.random(bytes(to, size)),
        proc_exit: status => {
            throw new Exit(status);
        },
        // A clock is waited for; anything else is ready.
        poll_oneoff: (list, to, count, count_at) => {
            for (let i = 0; i < count; i++) {
                const one = list + 48 * i, event = to + 32 * i, kind = view().getUint8(one + 8);
                if (kind === 0) system.sleep(Number(view().getBigUint64(one + 24, true)) / 1e6);
                bytes(event, 32).fill(0);
                put64(event, view().getBigUint64(one, true));
                view().setUint8(event + 10, kind);
            }
            put32(count_at, count);
        },
        fd_prestat_get: (number, to) => {
            if (number !== ROOT) fail('EBADF');
            put32(to, 0);
            put32(to + 4, 1);
        },
        fd_prestat_dir_name: (number, to, size) => put(to, size, new TextEncoder().encode(at(number).path)),
        fd_fdstat_get: (number, to) => {
            const { kind, stream } = at(number), rights = stream !== undefined ? ALL & ~SEEK & ~TELL : ALL;
            bytes(to, 24).fill(0);
            view().setUint8(to, kind);
            put64(to + 8, rights);
            put64(to + 16, rights);
        },
        fd_fdstat_set_flags: number => void at(number),
        fd_filestat_get: (number, to) => {
            const file = at(number), none = { size: 0, device: 0, number: 0, changed: 0 };
            put_status(to, file.kind === FOLDER ? system.status(file.path, true) : { ...none, ...file });
        },
        fd_read: (number, list, count, total_at) => each_piece(read, number, list, count, total_at),
        fd_write: (number, list, count, total_at) => each_piece(write, number, list, count, total_at),
        fd_seek: (number, offset, from, to) => {
            const file = at(number);
            if (file.stream !== undefined) fail('ESPIPE');
            const position = Number(offset) + [0, file.position, file.size][from];
            file.position = position >= 0 ? position : fail('EINVAL');
            put64(to, position);
        },
        // Entries from the one of that number on, as many bytes as there is room for; the last may be cut off.
        fd_readdir: (number, to, room, first, used_at) => {
            const entries = system.list(at(number).kind === FOLDER ? at(number).path : fail('ENOTDIR'));
            let used = 0;
            for (let i = Number(first); i < entries.length && used < room; i++) {
                const name = new TextEncoder().encode(entries[i].name), entry = new Uint8Array(24 + name.length);
                const head = new DataView(entry.buffer);
                head.setBigUint64(0, BigInt(i + 1), true);
                head.setUint32(16, name.length, true);
                head.setUint8(20, entries[i].kind);
                entry.set(name, 24);
                put(to + used, Math.min(entry.length, room - used), entry);
                used += Math.min(entry.length, room - used);
            }
            put32(used_at, used);
        },
        fd_sync: number => flush(at(number)),
        fd_close: number => {
            const file = at(number);
            delete open[number];
            flush(file);
        },
        path_open: (folder, follow, name, size, flags, rights, inherited, mode, to) => {
            const file = open_file(path(folder, name, size), follow & 1, flags, rights);
            let number = ROOT + 1;
            while (open[number] !== undefined) number++;
            open[number] = file;
            put32(to, number);
        },
        path_filestat_get: (folder, follow, name, size, to) =>
            put_status(to, system.status(path(folder, name, size), Boolean(follow & 1))),
        path_readlink: (folder, name, size, to, room, used_at) => {
            const target = new TextEncoder().encode(system.link(path(folder, name, size)));
            put(to, room, target);
            put32(used_at, Math.min(room, target.length));
        },
        path_rename: (folder, name, size, to_folder, to_name, to_size) =>
            system.rename(path(folder, name, size), path(to_folder, to_name, to_size)),
        path_unlink_file: (folder, name, size) => system.remove(path(folder, name, size)),
        path_create_directory: (folder, name, size) => system.make_folder(path(folder, name, size)),
        path_remove_directory: (folder, name, size) => system.remove_folder(path(folder, name, size)),
        path_link: () => fail('ENOTSUP'),
    };
    const answer = call => (...parameters) => {
        try {
            call(...parameters);
            return 0;
        } catch (error) {
            if (error.code === undefined) throw error;
            return ERRORS[error.code] ?? ERRORS.EIO;
        }
    };
    const imports = Object.fromEntries(Object.entries(calls).map(([name, call]) => [name, answer(call)]));
    const { exports } = new WebAssembly.Instance(module, { wasi_snapshot_preview1: imports });
    memory = exports.memory;
    try {
        exports._start();
        return 0;
    } catch (error) {
        if (error instanceof Exit) return error.status;
        throw error;
    }
}
