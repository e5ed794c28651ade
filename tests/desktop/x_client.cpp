// What a desktop does to a window, for tests of the player: another client of the X server, which drags
// something onto it, has something in the clipboard, or presses keys.
//
//   x_client TITLE drop URI-LIST    drops what a file manager or browser hands over (XDND 5)
//   x_client TITLE paste TEXT       owns the clipboard, presses Ctrl V and hands the text over
//   x_client TITLE press KEY...     presses keys by their names: x, F12
//
// TITLE is a part of the window's title; the window is waited for. Status 0: it took what it was given.
#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/keysym.h>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace {

constexpr auto kPatience = std::chrono::seconds(20);
constexpr long kXdndVersion = 5;

class Client {
 public:
  explicit Client(const std::string& title) : display_(XOpenDisplay(nullptr)) {
    if (display_ == nullptr) throw std::runtime_error("there is no display");
    XSetErrorHandler([](Display*, XErrorEvent*) { return 0; });  // windows come and go while one looks
    own_ = XCreateSimpleWindow(display_, root(), 0, 0, 1, 1, 0, 0, 0);
    wait([&] { return static_cast<bool>(find(root(), title)); }, "no window is called " + title);
    target_ = *find(root(), title);
  }
  ~Client() { XCloseDisplay(display_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  void drop(const std::string& uris) {
    wait([this] { return is_aware(); }, "the window takes no drops");
    own("XdndSelection");
    const long type = static_cast<long>(atom("text/uri-list"));
    tell("XdndEnter", {kXdndVersion << 24, type, 0, 0});
    const long middle = (40L << 16) | 40;
    tell("XdndPosition", {0, middle, CurrentTime, static_cast<long>(atom("XdndActionCopy"))});
    bool accepts = false;
    serve(uris, [&](const XEvent& event) {
      if (!is_message(event, "XdndStatus")) return false;
      accepts = (event.xclient.data.l[1] & 1) != 0;
      return true;
    });
    if (!accepts) throw std::runtime_error("the window does not accept a text/uri-list");
    tell("XdndDrop", {0, CurrentTime, 0, 0});
    serve(uris, [this](const XEvent& event) { return is_message(event, "XdndFinished"); });
  }

  void paste(const std::string& text) {
    own("CLIPBOARD");
    press("v", ControlMask);
    serve(text, [this](const XEvent&) { return served_; });
  }

  void press(const std::string& name, unsigned int modifiers = 0) {
    const KeySym symbol = XStringToKeysym(name.c_str());
    if (symbol == NoSymbol) throw std::runtime_error("there is no key " + name);
    XKeyEvent key{};
    key.display = display_;
    key.window = target_;
    key.root = root();
    key.time = ++time_;
    key.state = modifiers;
    key.same_screen = True;
    key.keycode = XKeysymToKeycode(display_, symbol);
    for (const int type : {KeyPress, KeyRelease}) {
      key.type = type;
      XEvent event{};
      event.xkey = key;
      XSendEvent(display_, target_, True, type == KeyPress ? KeyPressMask : KeyReleaseMask, &event);
    }
    XSync(display_, False);
  }

 private:
  Window root() const { return DefaultRootWindow(display_); }
  Atom atom(const char* name) const { return XInternAtom(display_, name, False); }

  void wait(const std::function<bool()>& done, const std::string& otherwise) const {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (!done()) {
      if (std::chrono::steady_clock::now() > end) throw std::runtime_error(otherwise);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }

  /// A window that can be seen, by its title.
  std::optional<Window> find(Window parent, const std::string& title) const {
    Window ignored = 0;
    Window* children = nullptr;
    unsigned int count = 0;
    if (XQueryTree(display_, parent, &ignored, &ignored, &children, &count) == 0) return std::nullopt;
    std::optional<Window> found;
    for (unsigned int i = 0; i < count && !found; ++i) {
      char* name = nullptr;
      XWindowAttributes attributes{};
      const bool is_it = XFetchName(display_, children[i], &name) != 0 &&
                         std::string(name).find(title) != std::string::npos &&
                         XGetWindowAttributes(display_, children[i], &attributes) != 0 &&
                         attributes.map_state == IsViewable;
      if (name != nullptr) XFree(name);
      found = is_it ? std::optional(children[i]) : find(children[i], title);
    }
    if (children != nullptr) XFree(children);
    return found;
  }

  bool is_aware() const {
    Atom type = None;
    int format = 0;
    unsigned long count = 0, left = 0;
    unsigned char* value = nullptr;
    XGetWindowProperty(display_, target_, atom("XdndAware"), 0, 1, False, XA_ATOM, &type, &format, &count,
                       &left, &value);
    if (value != nullptr) XFree(value);
    return count == 1;
  }

  void own(const char* selection) const {
    XSetSelectionOwner(display_, atom(selection), own_, CurrentTime);
    if (XGetSelectionOwner(display_, atom(selection)) != own_)
      throw std::runtime_error(std::string("cannot own ") + selection);
  }

  /// A client message whose first number is the window it comes from.
  void tell(const char* type, const std::vector<long>& numbers) const {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.display = display_;
    event.xclient.window = target_;
    event.xclient.message_type = atom(type);
    event.xclient.format = 32;
    event.xclient.data.l[0] = static_cast<long>(own_);
    // XdndEnter has its flags where others have nothing, and types behind them.
    for (std::size_t i = 0; i < numbers.size(); ++i) event.xclient.data.l[i + 1] = numbers[i];
    XSendEvent(display_, target_, False, NoEventMask, &event);
    XFlush(display_);
  }

  bool is_message(const XEvent& event, const char* type) const {
    return event.type == ClientMessage && event.xclient.message_type == atom(type);
  }

  /// Hands `text` to whoever asks for the selection, until an event is the one waited for.
  void serve(const std::string& text, const std::function<bool(const XEvent&)>& is_last) {
    wait(
        [&] {
          while (XPending(display_) > 0) {
            XEvent event;
            XNextEvent(display_, &event);
            if (event.type == SelectionRequest) hand_over(event.xselectionrequest, text);
            if (is_last(event)) return true;
          }
          return false;
        },
        "the window does not answer");
  }

  void hand_over(const XSelectionRequestEvent& request, const std::string& text) {
    const bool is_text = request.target == atom("UTF8_STRING") || request.target == atom("text/uri-list");
    if (is_text) {
      XChangeProperty(display_, request.requestor, request.property, request.target, 8, PropModeReplace,
                      reinterpret_cast<const unsigned char*>(text.data()), static_cast<int>(text.size()));
      served_ = true;
    }
    XEvent answer{};
    answer.xselection.type = SelectionNotify;
    answer.xselection.requestor = request.requestor;
    answer.xselection.selection = request.selection;
    answer.xselection.target = request.target;
    answer.xselection.property = is_text ? request.property : None;
    answer.xselection.time = request.time;
    XSendEvent(display_, request.requestor, False, NoEventMask, &answer);
    XSync(display_, False);
  }

  Display* display_;
  Window own_ = 0;
  Window target_ = 0;
  Time time_ = static_cast<Time>(std::chrono::duration_cast<std::chrono::milliseconds>(
                                     std::chrono::steady_clock::now().time_since_epoch())
                                     .count() &
                                 0x3fffffff);
  bool served_ = false;
};

int run(const std::vector<std::string>& words) {
  if (words.size() < 3) throw std::runtime_error("usage: x_client TITLE drop|paste|press WHAT...");
  Client client(words[0]);
  if (words[1] == "drop") {
    client.drop(words[2]);
  } else if (words[1] == "paste") {
    client.paste(words[2]);
  } else if (words[1] == "press") {
    for (std::size_t i = 2; i < words.size(); ++i) client.press(words[i]);
  } else {
    throw std::runtime_error(words[1] + ": drop, paste or press is expected");
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "x_client: %s\n", error.what());
    return 1;
  }
}
