"""What src/README.md allows: the table of who may include whom, and where heavy libraries stay."""

import re
from dataclasses import dataclass, field

# Heavy libraries: how src/README.md, an #include and a CMake target name them.
HEAVY = {
    "Bullet": (r"bullet/|Bullet(Dynamics|Collision|SoftBody)|LinearMath/|bt[A-Z]", r"BULLET"),
    "Embree": (r"embree", r"embree"),
    "OpenMP": (r"omp\.h", r"OpenMP::"),
    "MPI": (r"mpi\.h", r"MPI::"),
    "SQLite": (r"sqlite3", r"SQLite"),
    "nlohmann-json": (r"nlohmann/", r"nlohmann_json"),
    "CLI11": (r"CLI/", r"CLI11"),
    "tinyxml2": (r"tinyxml2", r"tinyxml2"),
    "libpng": (r"png\.h", r"PNG::"),
    "libjpeg": (r"(jpeglib|jerror)\.h", r"JPEG::"),
    "GDAL": (r"(gdal|cpl_|ogr)", r"GDAL::"),
    "libzip": (r"zip\.h", r"LIBZIP"),
    "zlib": (r"zlib\.h", r"ZLIB::"),
    "OpenSSL": (r"openssl/", r"OpenSSL::"),
    "Highway": (r"hwy/", r"HWY|hwy"),
    "Boost.Math": (r"boost/(?!context/)", r"Boost::(?!context)"),
    "Boost.Context": (r"boost/context/", r"Boost::context"),
    "pybind11": (r"pybind11/", r"pybind11::"),
}


class RulesError(Exception):
    """src/README.md does not say what the check needs."""


# Every folder may include these where they stand below it, without its row saying so.
FOR_ALL = ("core", "math")


@dataclass
class Rules:
    """What src/README.md allows."""

    named: dict = field(default_factory=dict)        # folder -> folders that its row names
    allowed: dict = field(default_factory=dict)      # folder -> folders it may include, with itself
    params_only: dict = field(default_factory=dict)  # folders that may include *_params.h only: but for which
    heavy: dict = field(default_factory=dict)        # library -> folders of its .cc files
    free: set = field(default_factory=set)           # folders that may call the C library's elementary functions

    def height(self, folder):
        """The number of the folder's row: what is lower stands below."""
        return list(self.named).index(folder)


def read_table(text):
    """Returns (named, params_only) from the table below "may also include", from the bottom up."""
    named, params_only = {}, {}
    lines = iter(text.splitlines())
    for line in lines:
        if re.match(r"\|\s*folder\s*\|\s*may also include\s*\|", line):
            next(lines)
            break
    else:
        raise RulesError('src/README.md has no table "| folder | may also include |"')
    for line in lines:
        if not line.startswith("|"):
            break
        folder, others = [cell.strip() for cell in line.strip().strip("|").split("|")][:2]
        if folder in named:
            raise RulesError(f"src/README.md: two rows for {folder}")
        note = re.search(r"\(([^)]*)\)", others)
        if note and "*_params.h" in note.group(1):
            whole = note.group(1).partition("but for")[2]
            params_only[folder] = {name.strip() for name in whole.split(",") if name.strip()}
        names = re.sub(r"\([^)]*\)", "", others)
        named[folder] = {name.strip() for name in names.split(",") if name.strip()}
    for folder, others in named.items():
        unknown = others - named.keys()
        if unknown:
            raise RulesError(f"src/README.md: {folder} may include unknown {sorted(unknown)}")
    return named, params_only


def allowed_by(named):
    """Folder -> all that it may include: itself, what its row names, core and math below it."""
    allowed, below = {}, set()
    for folder, others in named.items():
        allowed[folder] = others | {folder} | (below & set(FOR_ALL))
        below.add(folder)
    return allowed


def read_heavy(text, folders):
    """Returns library -> folders from rule 2: libraries, then the folders they are in, and so on."""
    rule = re.search(r"Heavy libraries stay(.*?)(?:\n\s*\n|\n3\.|\Z)", text, re.S)
    if not rule:
        raise RulesError('src/README.md has no rule "Heavy libraries stay ..."')
    sentence = rule.group(1).split("**", 1)[-1]
    names = sorted([*HEAVY, *folders], key=len, reverse=True)
    words = re.findall("|".join(rf"(?<!\w){re.escape(name)}(?!\w)" for name in names), sentence)
    heavy, current, last_was_library = {}, [], False
    for word in words:
        if word in HEAVY:
            current = [*current, word] if last_was_library else [word]
            heavy[word] = set()
        else:
            for library in current:
                heavy[library].add(word)
        last_was_library = word in HEAVY
    if not heavy or not all(heavy.values()):
        raise RulesError("src/README.md: rule 2 names no folder for some heavy library")
    return heavy


def read_free(text, folders):
    """Returns the folders that rule 4 names: whose numbers may differ by processor."""
    rule = re.search(r"\*\*One hash on every processor\.\*\*.*?\bonly\s(.*?)\smay\scall", text, re.S)
    if not rule:
        raise RulesError('src/README.md has no rule "One hash on every processor. ... only FOLDERS may call ..."')
    names = set(re.findall(r"\w+", rule.group(1))) - {"and"}
    if names - set(folders):
        raise RulesError(f"src/README.md: rule 4 names unknown {sorted(names - set(folders))}")
    return names


def read_rules(readme):
    text = readme.read_text(encoding="utf-8")
    named, params_only = read_table(text)
    return Rules(named, allowed_by(named), params_only, read_heavy(text, named.keys()),
                 read_free(text, named.keys()))
