// The editor in a notebook: the page in a frame, its text shared with Python.
export default {
  render({ model, el }) {
    const frame = Object.assign(document.createElement("iframe"), { title: "linkdyn editor", srcdoc: model.get("_page") });
    const size = () => { frame.style.cssText = `width: 100%; height: ${model.get("height")}px; border: 1px solid #8884; border-radius: 8px`; };
    const give = () => frame.contentWindow?.postMessage({ linkdyn: { text: model.get("text") } }, "*");
    const hear = ({ source, data }) => {
      if (source !== frame.contentWindow || !data?.linkdyn) return;
      if (data.linkdyn.ready) { give(); return; }
      model.set("text", data.linkdyn.text);
      model.save_changes();
    };
    addEventListener("message", hear);
    model.on("change:text", give);
    model.on("change:height", size);
    size();
    el.append(frame);
    return () => { removeEventListener("message", hear); model.off("change:text", give); model.off("change:height", size); };
  },
};
