"""Groups the rows of a table by the parameters that tell them apart."""

from collections import defaultdict
from collections.abc import Iterable

from csv_table import Row

# Parameters of the experiments, as columns. Columns that a table does not have are passed over.
KEYS = ("scene", "camera", "width", "height", "near_m", "far_near_ratio", "far_plane", "depth_convention", "depth_format",
        "depth_rounding", "derivatives", "scene_scale", "offset_m", "origin", "incidence_deg", "jitter_x_px", "jitter_y_px", "ray_offset", "tracer", "marcher", "bounds", "ascent",
        "march_code", "predictor", "least_chance", "least_chance_single", "path_step_m", "path_frames", "remaining_segment",
        "certified_misses", "check", "thickness_m",
        "stride_px", "confidence", "step_budget", "ray_kind", "roughness", "rays_per_pixel", "length_m", "light",
        "sun_elevation_degrees", "sun_azimuth_degrees", "tracer_mode", "footprint_factor", "layers", "guard_band", "free_space",
        "march_on", "confirm", "min_max", "caustics", "map_resolution", "rays_per_texel", "mirror_depth", "lights_visible",
        "lights_invisible", "emission", "first_surface", "visibility", "mixed", "gather_radius", "camera_paths",
        "roulette_threshold", "filter", "body", "ior", "incidence_degrees", "scale", "turn_degrees", "leaving_offset",
        "robust", "threads")
Group = tuple[tuple[str, str], ...]


def varying(rows: list[Row], keys: Iterable[str]) -> list[str]:
    """The keys that tell rows apart: not those that a scene fixes, such as the number of its lights."""
    scenes: dict[str, list[Row]] = defaultdict(list)
    for row in rows:
        scenes[row.get("scene", "")].append(row)
    return [k for k in keys if rows and k in rows[0]
            and (len(scenes) > 1 if k == "scene" else any(len({row[k] for row in members}) > 1 for members in scenes.values()))]


def groups_of(rows: list[Row], varied: Iterable[str], keys: Iterable[str] = KEYS) -> dict[Group, list[Row]]:
    """Rows that differ in the varied parameters alone, by those of the others that tell rows apart."""
    varied = set(varied)
    keys = [k for k in varying(rows, keys) if k not in varied]
    groups: dict[Group, list[Row]] = defaultdict(list)
    for row in rows:
        groups[tuple((k, row[k]) for k in keys)].append(row)
    return dict(groups)
