import { useFrame } from "@react-three/fiber";
import { useEffect, useState } from "react";
import { TVGLoader, type TVGMesh } from "tvg/three";

/** One loader for the page: its workers are shared by all meshes. */
const loader = new TVGLoader().preload();

export interface TvgModelProps {
  /** Address of the stream. */
  src: string;
  playing?: boolean;
  loop?: boolean;
  playbackRate?: number;
  /** Called with the mesh once its first frame is there. */
  onReady?: (mesh: TVGMesh) => void;
  onError?: (error: unknown) => void;
}

/** A mesh that plays, for react-three-fiber. */
export function TvgModel({ src, playing = true, loop = true, playbackRate = 1, onReady, onError }: TvgModelProps) {
  const [mesh, setMesh] = useState<TVGMesh>();

  useEffect(() => {
    let isGone = false;
    let loaded: TVGMesh | undefined;
    loader.loadAsync(src).then(
      (made) => {
        loaded = made;
        if (isGone) return made.dispose();
        setMesh(made);
        onReady?.(made);
      },
      (error) => isGone || onError?.(error),
    );
    return () => {
      isGone = true;
      loaded?.dispose();
      setMesh(undefined);
    };
  }, [src]);

  useEffect(() => {
    if (!mesh) return;
    mesh.loop = loop;
    mesh.playbackRate = playbackRate;
    if (playing) mesh.play();
    else mesh.pause();
  }, [mesh, playing, loop, playbackRate]);

  useFrame(() => mesh?.update());
  return mesh ? <primitive object={mesh} /> : null;
}
