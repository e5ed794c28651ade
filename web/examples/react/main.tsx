import { Canvas } from "@react-three/fiber";
import { createRoot } from "react-dom/client";
import { TvgModel } from "./TvgModel";

const src = new URLSearchParams(location.search).get("stream") ?? "clip.tvg";

createRoot(document.getElementById("root")!).render(
  <Canvas camera={{ position: [0, 1, 4] }}>
    <hemisphereLight intensity={3} groundColor={0x445566} />
    <TvgModel src={src} onReady={(mesh) => Object.assign(globalThis, { mesh })} onError={console.error} />
  </Canvas>,
);
