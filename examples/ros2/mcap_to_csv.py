#!/usr/bin/env python3
"""Makes paths and tables of a ROS 2 bag in MCAP, without ROS.

mcap_to_csv.py BAG [--out DIR] [--csv TOPIC]. Names the topics; with --out it writes the poses of
Odometry, PoseStamped, PoseWithCovarianceStamped and TFMessage as DIR/TOPIC.tum (t x y z qx qy qz qw)
and skips other types. With --csv any topic is printed as a table: a row per message, or per element
of its one list of messages. The columns are the paths of the fields, such as header.stamp.sec.
Bags packed by zstd need python3-zstandard, by lz4 python3-lz4. Format: https://mcap.dev/spec; CDR.
"""
import argparse
import csv
import pathlib
import struct
import sys

MAGIC = b"\x89MCAP0\r\n"
SIZES = dict(zip(("bool byte char int8 uint8 int16 uint16 int32 uint32 int64 uint64 float32 "
                  "float64").split(), "?BBbBhHiIqQfd"))
POSES = {"nav_msgs/msg/Odometry": "pose.pose.", "geometry_msgs/msg/PoseStamped": "pose.",
         "geometry_msgs/msg/PoseWithCovarianceStamped": "pose.pose."}
TRANSFORMS = "tf2_msgs/msg/TFMessage"

def unpacked(name, data, size):
    if name == "":
        return data
    try:
        if name == "lz4":
            return __import__("lz4.frame").frame.decompress(data)
        return __import__("zstandard").ZstdDecompressor().decompress(data, max_output_size=size)
    except ImportError:
        sys.exit(f"the bag is packed by {name}: install python3-zstandard or python3-lz4")

class Bytes:
    """Little-endian numbers and strings of MCAP's records."""
    def __init__(self, data):
        self.data, self.at = data, 0
    def take(self, form):
        values = struct.unpack_from("<" + form, self.data, self.at)
        self.at += struct.calcsize("<" + form)
        return values[0] if len(values) == 1 else values
    def block(self, form="I"):
        size = self.take(form)
        self.at += size
        return self.data[self.at - size:self.at]
    def text(self):
        return self.block().decode()

def records(data):
    at = 0
    while at + 9 <= len(data):
        opcode, size = struct.unpack_from("<BQ", data, at)
        if at + 9 + size > len(data):
            print("the bag is cut off: what is whole is read", file=sys.stderr)
            return
        yield opcode, data[at + 9:at + 9 + size]
        at += 9 + size

def messages(path):
    """Type, definition, topic and bytes of each message, in the file's order."""
    data = pathlib.Path(path).read_bytes()
    if not data.startswith(MAGIC):
        sys.exit(f"{path}: is not MCAP")
    schemas, channels = {}, {}

    def walk(part):
        for opcode, content in records(part):
            record = Bytes(content)
            if opcode == 3:
                number, name, _, text = record.take("H"), record.text(), record.text(), record.block()
                schemas[number] = (name, text.decode(errors="replace"))
            elif opcode == 4:
                number, schema, topic = record.take("H"), record.take("H"), record.text()
                channels[number] = (*schemas.get(schema, ("?", "")), topic, record.text())
            elif opcode == 5:
                channel = record.take("H")
                record.take("IQQ")
                yield (*channels[channel], content[record.at:])
            elif opcode == 6:
                _, _, size, _ = record.take("QQQI")
                yield from walk(unpacked(record.text(), record.block("Q"), size))
    yield from walk(data[len(MAGIC):])

def definitions(name, text):
    """Type -> [(field, type, length of an array: None, 0 for any, or a number)]."""
    types, current = {name: []}, name
    for line in text.splitlines():
        words = line.split("#")[0].split()
        if words[:1] == ["MSG:"]:
            current = words[1]
            types[current] = []
        elif len(words) > 1 and "=" not in "".join(words[1:3]):  # Constants have a sign.
            kind, _, bound = words[0].rstrip("]").partition("[")
            length = None if "[" not in words[0] else int(bound) if bound.isdigit() else 0
            types[current].append((words[1], kind.split("<=")[0], length))
    return {kind.replace("/msg/", "/"): fields for kind, fields in types.items()}

class Cdr:
    """A message, by the definitions of its types."""
    def __init__(self, data, types):
        self.data, self.types, self.at = data, types, 4
        self.order = "<" if data[1] & 1 else ">"
    def number(self, form):
        size = struct.calcsize(form)
        self.at += -(self.at - 4) % size
        self.at += size
        return struct.unpack_from(self.order + form, self.data, self.at - size)[0]
    def value(self, kind, package):
        if kind in SIZES:
            return self.number(SIZES[kind])
        if kind == "string":
            size = self.number("I")
            self.at += size
            return self.data[self.at - size:self.at].rstrip(b"\0").decode(errors="replace")
        if kind in ("time", "duration", "builtin_interfaces/Time", "builtin_interfaces/Duration"):
            return {"sec": self.number("i"), "nanosec": self.number("I")}
        kind = {"Header": "std_msgs/Header"}.get(kind, kind.replace("/msg/", "/"))
        return self.message(kind if "/" in kind else f"{package}/{kind}")
    def message(self, kind):
        value, package = {}, kind.split("/")[0]
        for name, field, length in self.types[kind]:
            count = 1 if length is None else length or self.number("I")
            values = [self.value(field, package) for _ in range(count)]
            value[name] = values[0] if length is None else values
        return value

def flat(value, prefix=""):
    row, lists = {}, []
    for name, part in value.items():
        if isinstance(part, dict):
            inner, more = flat(part, prefix + name + ".")
            row.update(inner)
            lists += more
        elif isinstance(part, list) and (not part or isinstance(part[0], dict)):
            lists.append(part)
        elif isinstance(part, list):
            row.update({f"{prefix}{name}.{i}": one for i, one in enumerate(part)})
        else:
            row[prefix + name] = part
    return row, lists

def pose_lines(kind, topic, message):
    """Name of a path and a line of it."""
    position, turn = POSES.get(kind, "") + "position.", POSES.get(kind, "") + "orientation."
    for one in message["transforms"] if kind == TRANSFORMS else [message]:
        row, name = flat(one)[0], topic
        if kind == TRANSFORMS:
            position, turn = "transform.translation.", "transform.rotation."
            name = f"{topic}_{row['header.frame_id']}_{row['child_frame_id']}"
        numbers = [row[position + c] for c in "xyz"] + [row[turn + c] for c in "xyzw"]
        stamp = f"{row['header.stamp.sec']}.{row['header.stamp.nanosec']:09d}"
        yield name, " ".join([stamp] + [repr(number) for number in numbers])

def print_rows(writer, row, lists):
    full = [part for part in lists if part]
    if len(full) > 1:
        sys.exit("the messages hold several lists of messages")
    for part in full[0] if full else [] if lists else [{}]:
        whole = {**row, **flat(part)[0]}
        if writer is None:
            writer = csv.DictWriter(sys.stdout, list(whole), extrasaction="ignore")
            writer.writeheader()
        writer.writerow(whole)
    return writer

def write_paths(folder, paths):
    folder.mkdir(parents=True, exist_ok=True)
    for name, lines in sorted(paths.items()):
        by_time = {float(line.split()[0]): line for line in lines}
        whole = ["# t x y z qx qy qz qw"] + [by_time[time] for time in sorted(by_time)]
        (folder / f"{name}.tum").write_text("\n".join(whole) + "\n", encoding="utf-8")
        print(f"{folder / name}.tum: {len(by_time)} poses")

def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    for name, words in (("bag", "a file"), ("--out", "folder of paths"), ("--csv", "topic to print")):
        parser.add_argument(name, help=words)
    arguments = parser.parse_args()
    counts, paths, writer = {}, {}, None
    for kind, text, topic, encoding, data in messages(arguments.bag):
        has_poses = encoding == "cdr" and (kind in POSES or kind == TRANSFORMS)
        counts[topic, kind, has_poses] = counts.get((topic, kind, has_poses), 0) + 1
        if topic == arguments.csv:
            writer = print_rows(writer, *flat(Cdr(data, definitions(kind, text)).value(kind, "")))
        elif arguments.out and has_poses:
            for name, line in pose_lines(kind, topic, Cdr(data, definitions(kind, text)).value(kind, "")):
                paths.setdefault(name.strip("/").replace("/", "_"), []).append(line)
    if arguments.csv and writer is None:
        sys.exit(f"{arguments.bag}: no messages of {arguments.csv}")
    for (topic, kind, has_poses), count in [] if arguments.csv else sorted(counts.items()):
        skipped = ", skipped" if arguments.out and not has_poses else ""
        print(f"{topic}: {kind}, {count} messages{skipped}")
    if arguments.out:
        write_paths(pathlib.Path(arguments.out), paths)

if __name__ == "__main__":
    try:
        main()
    except (OSError, struct.error, KeyError, IndexError, ValueError) as error:
        sys.exit(f"the bag cannot be read: {type(error).__name__}: {error}")
