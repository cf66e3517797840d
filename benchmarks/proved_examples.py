"""The rules files whose generated C is proved."""

EXAMPLES = (
    "examples/thesis/mobile_base.ross",
    "examples/thesis/arm.ross",
    "examples/thesis/peg_in_hole.ross",
    "examples/husky/husky.ross",
    "examples/demo/demo.ross",
)
