"""The scout on an arm: views are poses of the flange, and the arm says where it really went.

    python3 docs/examples/python/scout_with_arm.py OUT.png

`Arm` stands for the robot's driver. Here it knows two poses, those of the recorded images.
"""

import json
import pathlib
import sys

import numpy as np

import edgescout

EXAMPLES = pathlib.Path(__file__).resolve().parents[1]
scene = EXAMPLES / "scenes/000001"
views = json.loads((scene / "scene_camera.json").read_text())

# From the hand-eye calibration: the camera looks along the flange's z, 5 cm beside it.
flange_from_camera = np.eye(4)
flange_from_camera[:3, 3] = 0.05, 0, 0.03


class Arm:
    def __init__(self):
        self.poses = []  # base_from_flange; the base is the world of the scene
        for view in views.values():
            camera_from_base = np.eye(4)
            camera_from_base[:3, :3] = np.reshape(view["cam_R_w2c"], (3, 3))
            camera_from_base[:3, 3] = np.array(view["cam_t_w2c"]) / 1000
            self.poses.append(np.linalg.inv(flange_from_camera @ camera_from_base))

    def move_to(self, view):
        """Where the encoders say that the flange is after the motion; None: not reachable."""
        self.view = view
        return self.poses[view]

    def take_image(self):
        return edgescout.load_image(scene / f"gray/{self.view:06}.png")


def camera_from_base(base_from_flange):
    return np.linalg.inv(base_from_flange @ flange_from_camera)


arm = Arm()
arm.move_to(0)
height, width = arm.take_image().shape
camera = edgescout.Camera(width, height, np.reshape(views["0"]["cam_K"], (3, 3)))
templates = edgescout.Templates(
    edgescout.load_mesh(EXAMPLES / "parts/obj_000006.ply", "mm"),
    edgescout.TemplateOptions(distance_min=0.45, distance_max=0.52))
planned = np.array([camera_from_base(pose) for pose in arm.poses])
scout = edgescout.Scout(templates, camera, planned, edgescout.ScoutOptions(max_views=5))

while (proposal := scout.propose()) is not None:
    reached = arm.move_to(proposal.view)
    if reached is None:
        scout.unreachable(proposal.view, "the arm refused the motion")
        continue
    scout.give(proposal.view, arm.take_image(), camera_from_base(reached))
    print(f"view {proposal.view}: entropy {scout.entropy_nats:.3f} nats, "
          f"{len(scout.detections)} objects")
print("end:", scout.end)
for instance in scout.detections:  # the world is the arm's base
    print(f"probability {instance.probability:.2f}, base_from_object\n",
          instance.world_from_object.round(4))

picture = edgescout.overlay(arm.take_image(), camera, scout.detections, templates,
                            camera_from_world=planned[arm.view])
edgescout.save_png(picture, sys.argv[1])
