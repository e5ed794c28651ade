"""Writes what §5.7 to §5.9 code, by the reference decoder's own code."""
import types

import tvg_reference as reference
from tvg_writer import RangeEncoder

class Usual(RangeEncoder):
    """Answers with what it was told to say and then as usual: with a symbol, or zero bits."""
    def __init__(self, values, usual):
        super().__init__()
        self.usual = usual
        self.say(*values)

    def or_else(self, value):
        if not self.queue:
            self.say(value)

    def symbol(self, a, b=None):
        self.or_else(self.usual)
        return super().symbol(a, b)

    def bit(self, model):
        self.or_else(0)
        return super().bit(model)

    def raw(self, k):
        self.or_else(0)
        return super().raw(k)

    bits = raw

def written(use, values, usual):
    """The range-coder stream of what use(coding) reads while its coder says these values, valid or not, and then as usual."""
    coder = Usual(values, usual)
    coding = types.SimpleNamespace(**(vars(reference) | {"RangeDecoder": lambda data, user: coder}))
    try:
        use(coding)
    except reference.Invalid:  # it has read what breaks a rule
        coder.clear()
    coder.finish()
    return coder.data
