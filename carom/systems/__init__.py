"""What happens: the step, its forces, detection and response, and the simulation that owns them."""
