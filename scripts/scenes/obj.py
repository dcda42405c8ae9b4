"""A scene as a text of the format OBJ."""


def write_obj(path, parts):
    """In millimetres with z up; a group for each part, and usemtl for its materials. Returns the size."""
    lines, first = ["# millimetres, z up"], 1
    for part in parts:
        lines.append(f"g {part.name}")
        for k in range(0, len(part.vertices), 3):
            # Stored as (x, z, -y) in metres.
            x, z, y = part.vertices[k], part.vertices[k + 1], -part.vertices[k + 2]
            lines.append("v " + " ".join(f"{round(1000 * value, 1) + 0.0:g}" for value in (x, y, z)))
        for material, numbers in part.indices.items():
            lines.append(f"usemtl {material}")
            for k in range(0, len(numbers), 3):
                lines.append("f " + " ".join(str(first + number) for number in numbers[k:k + 3]))
        first += len(part.vertices) // 3
    data = ("\n".join(lines) + "\n").encode()
    with open(path, "wb") as file:
        file.write(data)
    return len(data)
