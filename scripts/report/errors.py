"""What is wrong with the inputs, in one sentence that names the place."""


class InputError(Exception):
    pass
