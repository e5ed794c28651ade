"""An export in steps, so that a window can be kept alive between them."""
import queue
import threading

import tvg

from .evaluation import Evaluation


class Encoding:
    """tvg.encode() in a thread of its own, which takes frames as they come."""

    _AHEAD = 4  # frames that wait for the encoder at most

    def __init__(self, path, options):
        self._frames = queue.Queue(self._AHEAD)
        self._cancelled = False
        self._report = self._error = None
        self._thread = threading.Thread(target=self._run, args=(path, options), daemon=True)
        self._thread.start()

    def _run(self, path, options):
        try:
            self._report = tvg.encode(self._taken(), out=path, progress=self._go_on, **options)
        except BaseException as error:  # also what a library underneath raises is the caller's to tell
            self._error = error

    def _taken(self):
        while True:
            frame = self._frames.get()
            self._go_on()
            if frame is None:
                return
            yield frame

    def _go_on(self, *_):
        if self._cancelled:
            raise InterruptedError("cancelled")

    def full(self):
        """Whether the encoder has not caught up: another frame would have to wait."""
        return self._thread.is_alive() and self._frames.full()

    def add(self, frame):
        """Hands over a frame, or None after the last; waits where the encoder is busy. Raises what stopped it."""
        while self._thread.is_alive():
            try:
                self._frames.put(frame, timeout=0.05)
                return
            except queue.Full:
                pass
        raise self._error

    def report(self):
        """What tvg.encode() returns, or None while it is at work. Raises what it raised."""
        if self._thread.is_alive():
            return None
        if self._error is not None:
            raise self._error
        return self._report

    def cancel(self):
        """Stops it, and waits until nothing is left of its file."""
        self._cancelled = True
        while self._thread.is_alive():
            try:
                self._frames.put(None, timeout=0.05)
            except queue.Full:
                pass
            self._thread.join(0.05)


class ExportJob:
    """Evaluates frame after frame of the scene's range, and encodes them.

    Where the mesh changes on the way, the range is gone through once for the largest mesh, which a stream says at its
    beginning, and once more to encode.
    """

    def __init__(self, context, items, path, options, uvs):
        self._context, self._scene, self._items, self._uvs = context, context.scene, items, uvs
        self._path, self._options = path, options
        self._shown = self._scene.frame_current
        self._range = range(self._scene.frame_start, self._scene.frame_end + 1)
        self._has_faces = False
        self._limits = None  # of changing meshes, once they are known
        self._begin(True)

    def _begin(self, encoding):
        self._evaluation = Evaluation(self._items, self._uvs)
        self._mesh = None
        self._next = 0
        self._survey = None if encoding else {"vertices": 0, "faces": 0, "property_bytes": 0}
        self._encoding = Encoding(self._path, {**self._options, "limits": self._limits}) if encoding else None

    @property
    def progress(self):
        """Which frame is at hand, of how many, and what is done with it."""
        return self._next, len(self._range), "measuring" if self._encoding is None else "encoding"

    def step(self):
        """A frame further. The report at the end, else None. Raises what stands in the way, and leaves no file then."""
        try:
            return self._step()
        except BaseException:
            self.cancel()
            raise

    def _step(self):
        if self._encoding is not None and (self._next > len(self._range) or self._encoding.full()):
            return self._encoding.report()
        if self._next == len(self._range):
            self._end_pass()
            return None
        self._scene.frame_set(self._range[self._next])
        frame = self._evaluation.frame(self._context)
        changed = self._mesh is not None and frame.mesh is not self._mesh
        self._mesh = frame.mesh
        self._has_faces = self._has_faces or len(frame.mesh.faces) > 0
        if self._encoding is not None and changed and self._limits is None:
            self._encoding.cancel()
            self._begin(False)
            return None
        self._next += 1
        if self._encoding is not None:
            self._encoding.add(frame)
            return None
        if changed or self._next == 1:
            mesh = frame.mesh
            sizes = {"vertices": mesh.vertex_count, "faces": len(mesh.faces), "property_bytes": mesh.property_bytes()}
            self._survey = {name: max(size, self._survey[name]) for name, size in sizes.items()}
        return None

    def _end_pass(self):
        if self._encoding is None:
            self._limits = self._survey
            self._begin(True)
        else:
            if not self._has_faces:
                raise ValueError("the selected meshes have no face in any frame")
            self._encoding.add(None)
            self._next += 1

    def cancel(self):
        """Stops; nothing is left of the file."""
        if self._encoding is not None:
            self._encoding.cancel()

    def restore(self):
        """Shows the frame again that was shown before."""
        self._scene.frame_set(self._shown)
