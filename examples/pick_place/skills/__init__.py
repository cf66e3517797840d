"""Skills of a robot that picks things and places them."""
