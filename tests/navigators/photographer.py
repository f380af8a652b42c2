"""photographer.cc as a process: the same sums in the same order."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "examples/navigators"))
from rockyard_navigator import Navigator, gave_up, look, parameter, run  # noqa: E402


def byte_sum(image):
    """Bytes have the weights of their columns and rows."""
    if not isinstance(image.grey, bytes) or len(image.grey) != image.width * image.height:
        raise ValueError("no bytes of the image's size")
    return sum(grey * (1 + at % image.width + 1000 * (at // image.width)) for at, grey in enumerate(image.grey))


def camera_sum(image):
    total = 0.0
    for weight, number in enumerate([*image.C_R, *image.A_R, *image.H_R, *image.V_R], 1):
        total += weight * number
    return total


class Photographer(Navigator):
    name, doc, version = "photographer", "tells what images it gets", "1"
    parameters = [parameter("goal_tolerance_m", "real", 0.3, "never arrives", min=0, max=5)]
    own_values = [(name, "1", "") for name in ("images", "left", "right", "left_camera", "right_camera", "numbers",
                                               "behind", "others")]

    def traits(self):
        return {**super().traits(), "images": True}

    def decide(self, input):
        if input.images:
            own, images = self.own, input.images
            own["images"] += 1
            own["left"] += byte_sum(images.left)
            own["right"] += byte_sum(images.right)
            own["left_camera"] += camera_sum(images.left)
            own["right_camera"] += camera_sum(images.right)
            own["numbers"] += images.number
            own["behind"] += images.direction == "behind"
            own["others"] += bool(input.cloud or input.report)
        if self.own["images"] == 3:
            return gave_up()
        return look("behind" if self.own["images"] == 1 else "ahead")


run(Photographer)
