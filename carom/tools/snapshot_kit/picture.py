"""Picture: the layer of a golden that holds how a world looks, compared patch by patch.

A patch is `PATCH` x `PATCH` pixels, wherever it lies. Its colour is a mean, so that noise and single pixels hardly
count; but a body that moved by a tenth of its radius changes the patches along its edge, however small its share of the
picture is. Measured in library worlds at 320 x 240 px: of all bodies that cover 12 px or more such a move changes some
patch by at least 3.4 of 255; noise of one step a pixel does by 0.8 at most. Pictures that differ in nothing but their
anti-aliasing differ by 7 to 13 (16 samples a pixel instead of 4) or 10 to 35 (1 sample).
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import numpy.typing as npt

Picture = npt.NDArray[np.uint8]

PATCH = 4  # px
LIMIT = 2.5  # of 255: by how much the mean colour of a patch may differ on the driver that drew the golden
LIMIT_ELSEWHERE = 40.0  # and on others, which draw edges their own way
SHOWN = 24  # of 255: what differs by this much is shown in full red


def picture_fault(actual: Picture, golden: Picture, *, same_driver: bool) -> str | None:
    """Return by how much two pictures differ when that is too much, or None."""
    if actual.shape != golden.shape:
        return (
            f"the picture is {actual.shape[1]} x {actual.shape[0]} px, the golden {golden.shape[1]} x {golden.shape[0]}"
        )
    patches = patch_difference(actual, golden)
    limit = LIMIT if same_driver else LIMIT_ELSEWHERE
    if patches.max() <= limit:
        return None
    row, column = np.unravel_index(int(patches.argmax()), patches.shape)
    where = "the driver that drew the golden" if same_driver else "another driver than the golden's"
    return (
        f"{PATCH} x {PATCH} px from ({column}, {row}) on differ by {patches.max():.1f} of 255, "
        f"at most {limit:g} may on {where}"
    )


def patch_difference(actual: Picture, golden: Picture) -> npt.NDArray[np.float64]:
    """Return by how much (of 255) the mean of the worst channel differs in each patch, by its upper left pixel.

    Both pictures are (height, width, 3); smaller ones than a patch count as one.
    """
    difference = actual.astype(np.int64) - golden
    tall, wide = (min(PATCH, length) for length in difference.shape[:2])
    sums = np.pad(difference, ((1, 0), (1, 0), (0, 0))).cumsum(axis=0).cumsum(axis=1)
    patches = sums[tall:, wide:] - sums[:-tall, wide:] - sums[tall:, :-wide] + sums[:-tall, :-wide]
    return np.asarray(np.abs(patches).max(axis=2) / (tall * wide))


def difference_picture(actual: Picture, golden: Picture) -> Picture:
    """Return the golden in pale grey, red where the worst channel differs."""
    grey = 160.0 + golden.mean(axis=2) * (95.0 / 255.0)
    worst = np.abs(actual.astype(np.int64) - golden).max(axis=2)
    share = np.minimum(worst / SHOWN, 1.0)[..., None]
    red = np.array([220.0, 0.0, 30.0])
    shown: Picture = np.rint(grey[..., None] * (1.0 - share) + red * share).astype(np.uint8)
    return shown


def read_picture(path: Path) -> Picture:
    """Return a PNG as (height, width, 3)."""
    from PIL import Image

    with Image.open(path) as image:
        return np.asarray(image.convert("RGB"))


def write_picture(path: Path, picture: Picture) -> None:
    """Write a picture (height, width, 3) as PNG."""
    from PIL import Image

    Image.fromarray(picture).save(path)
